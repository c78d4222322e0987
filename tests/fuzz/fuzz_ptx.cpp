// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  unseen::io::fuzz_points({data, data + size}, "a.ptx");
  return 0;
}
