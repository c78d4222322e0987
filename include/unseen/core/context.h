// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "unseen/core/summary.h"

namespace unseen {

/// What a caller lends to a run: progress, cancellation, log and a thread limit. The library itself prints
/// nothing. Use one Context from one thread.
class Context {
 public:
  /// Called with the stage's name and the share of it that is done, in [0,1].
  std::function<void(std::string_view stage, double fraction)> on_progress;
  /// Called with each remark worth a line; warnings come here as well as into the summary.
  std::function<void(std::string_view message)> on_message;
  std::stop_token stop;  ///< request_stop() on its source ends the run at the next check()
  int threads = 0;       ///< at most this many threads; 0 = as many as the machine has

  /// Throws Cancelled if a stop was requested. Cheap enough for inner loops over blocks of work.
  void check() const;
  /// check(), then reports progress of the current stage.
  void progress(double fraction) const;
  void message(std::string_view text) const;
  void warn(std::string text);
  /// Warnings since the last call.
  std::vector<std::string> take_warnings();

 private:
  friend class Stage;
  std::string stage_;
  std::vector<std::string> warnings_;
};

/// Names the current stage while it lives and adds its wall time to `summary.seconds` when it ends.
class Stage {
 public:
  Stage(Context& context, Summary& summary, std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  Context& context_;
  Summary& summary_;
  std::chrono::steady_clock::time_point start_;
};

/// Runs body(begin, end) over [0, count) in blocks of `grain` on at most context.threads threads.
/// Which block runs on which thread is open, so a body may write only what its own indices own.
void parallel_blocks(const Context& context, std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace unseen
