// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/lzf.h"

namespace unseen::io {

bool lzf_decompress(std::string_view in, std::size_t size, std::string& result) {
  // Three bytes give at most 264: what claims more is broken, and is not worth its memory.
  if (size / 88 > in.size()) return false;
  result.clear();
  result.reserve(size);
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<unsigned char>(in[at++]); };
  while (at < in.size()) {
    const unsigned control = byte();
    if (control < 32) {  // a run of control + 1 literal bytes
      const std::size_t length = control + 1;
      if (length > in.size() - at || length > size - result.size()) return false;
      result.append(in, at, length);
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at == in.size()) return false;
      length += byte();
    }
    length += 2;
    if (at == in.size()) return false;
    const std::size_t distance = ((control & 31u) << 8 | byte()) + std::size_t{1};
    if (distance > result.size() || length > size - result.size()) return false;
    for (std::size_t i = 0; i < length; ++i) result.push_back(result[result.size() - distance]);
  }
  return result.size() == size;
}

}  // namespace unseen::io
