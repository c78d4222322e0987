// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <stdexcept>
#include <string>

namespace unseen {

/// The caller's fault: a file or an option that cannot be used. The message is one line that names
/// the source (file or option), the field, what was found and what was expected.
class InputError : public std::runtime_error {
 public:
  InputError(std::string source, std::string field, std::string found, std::string expected);

  std::string source, field, found, expected;
};

/// Thrown by Context::check() when the caller asked to stop; capabilities turn it into Status::cancelled.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace unseen
