// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  for (const char* name : {"a.obj", "a.off", "a.stl", "a.ply"})
    unseen::io::fuzz_mesh({data, data + size}, name);
  return 0;
}
