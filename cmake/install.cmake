# SPDX-License-Identifier: MIT
# Makes `find_package(unseen)` work for users of an installed copy.
include(CMakePackageConfigHelpers)
get_property(unseen_libraries GLOBAL PROPERTY unseen_libraries)
install(TARGETS ${unseen_libraries} unseen_unseen EXPORT unseen
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS unseen_codecs LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/unseen)
install(TARGETS unseen_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/unseen)
install(DIRECTORY include/unseen ${PROJECT_BINARY_DIR}/include/unseen DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT unseen NAMESPACE unseen:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/unseen
  FILE unseen-targets.cmake)
configure_package_config_file(cmake/unseen-config.cmake.in ${PROJECT_BINARY_DIR}/unseen-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/unseen)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/unseen-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/unseen-config.cmake ${PROJECT_BINARY_DIR}/unseen-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/unseen)
