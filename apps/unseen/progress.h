// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::cli {

/// Shows a run on standard error: one line that is rewritten (stage, share, time left), only if that is a
/// terminal. `quiet` shows nothing.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Lets the context report here; it must not be used after this object's end.
  void attach(Context& context);
  void show(std::string_view stage, double fraction);
  /// Takes the line away.
  void clear();
  /// A line for each warning, once the run is over: a run that fails says one thing only.
  void warn(const std::vector<std::string>& warnings);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, drawn_ = false;
  std::string stage_;
  Clock::time_point stage_start_{}, last_{};
};

/// "12 s", "3 min", "2 h"
std::string rough_duration(double seconds);

}  // namespace unseen::cli
