// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <string_view>

#include "unseen/report/scenelets_file.h"

// data/scenelets.bin as the assembler takes it in.
__asm__(
    ".section .rodata\n"
    ".global unseen_scenelets_begin\n"
    ".global unseen_scenelets_end\n"
    "unseen_scenelets_begin:\n"
    ".incbin \"" UNSEEN_SCENELETS "\"\n"
    "unseen_scenelets_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" const char unseen_scenelets_begin[], unseen_scenelets_end[];

namespace unseen::report {

const interactions::Database& shipped_database() {
  static const interactions::Database database =
      parse_database(std::string_view(unseen_scenelets_begin, static_cast<std::size_t>(unseen_scenelets_end - unseen_scenelets_begin)), "the shipped scenelets");
  return database;
}

}  // namespace unseen::report
