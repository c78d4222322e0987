// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace unseen::io {

/// Appends a number with its least significant byte first.
template <class T>
void append_little(std::string& to, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(T));
  to.append(bytes, sizeof(T));
}

/// The nearest integer that T holds; not-a-number becomes 0.
template <class T>
T clamped(double value) {
  if (std::isnan(value)) return T{0};
  return static_cast<T>(std::clamp(std::round(value), static_cast<double>(std::numeric_limits<T>::min()),
                                   static_cast<double>(std::numeric_limits<T>::max())));
}

}  // namespace unseen::io
