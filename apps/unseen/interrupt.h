// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <stop_token>
#include <thread>

namespace unseen::cli {

/// While it lives, the first Ctrl-C (SIGINT, SIGTERM or SIGHUP) asks the run to stop, the second one (but for SIGHUP) kills the
/// program with exit code 130. Make it before any other thread is started.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace unseen::cli
