# SPDX-License-Identifier: MIT
# unseen_library(NAME SOURCES … [PUBLIC targets…] [PRIVATE targets…])
# One library a folder of src: target unseen_NAME, alias unseen::NAME.
function(unseen_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(unseen_${name} STATIC ${arg_SOURCES})
  add_library(unseen::${name} ALIAS unseen_${name})
  set_target_properties(unseen_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(unseen_${name} PUBLIC cxx_std_20)
  target_include_directories(unseen_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
           $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(unseen_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY unseen_libraries unseen_${name})
endfunction()

# unseen_sources(FOLDER names…)
# A folder's files without their endings, as a list of that name.
function(unseen_sources folder)
  list(TRANSFORM ARGN PREPEND ${folder}/)
  list(TRANSFORM ARGN APPEND .cpp)
  set(${folder} ${ARGN} PARENT_SCOPE)
endfunction()
