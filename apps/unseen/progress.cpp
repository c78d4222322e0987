// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace unseen::cli {
namespace {

/// Text from files must not steer the terminal.
std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return out;
}

/// Unlike fmt's, it does not mind that nobody reads it.
void print(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

std::string rough_duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 5400) return fmt::format("{:.0f} min", std::round(seconds / 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(!quiet && isatty(STDERR_FILENO) == 1) {}

void Progress::attach(Context& context) {
  if (terminal_)
    context.on_progress = [this](std::string_view stage, double fraction) { show(stage, fraction); };
}

void Progress::show(std::string_view stage, double fraction) {
  if (!terminal_) return;
  constexpr auto kEvery = std::chrono::milliseconds(100);
  constexpr int kBar = 24;
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  } else if (now - last_ < kEvery) {
    return;
  }
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  std::string left;
  if (fraction > 0.02 && elapsed > 1.0)
    left = ", " + rough_duration(elapsed * (1 - fraction) / fraction) + " left";
  const int filled = static_cast<int>(fraction * kBar);
  print(fmt::format("\r\x1b[K{:<14} [{}{}] {:3.0f} %{}", printable(stage), std::string(filled, '='), std::string(kBar - filled, ' '), 100 * fraction, left));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::warn(const std::vector<std::string>& warnings) {
  clear();
  if (quiet_) return;
  for (const std::string& warning : warnings) print(fmt::format("unseen: warning: {}\n", printable(warning)));
}

void Progress::clear() {
  if (drawn_) print("\r\x1b[K");
  drawn_ = false;
}

}  // namespace unseen::cli
