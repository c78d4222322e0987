// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/context.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "unseen/core/error.h"

namespace unseen {

void Context::check() const {
  if (stop.stop_requested()) throw Cancelled();
}

void Context::progress(double fraction) const {
  check();
  if (on_progress) on_progress(stage_, fraction);
}

void Context::message(std::string_view text) const {
  if (on_message) on_message(text);
}

void Context::warn(std::string text) {
  message("warning: " + text);
  warnings_.push_back(std::move(text));
}

std::vector<std::string> Context::take_warnings() { return std::exchange(warnings_, {}); }

Stage::Stage(Context& context, Summary& summary, std::string name)
    : context_(context), summary_(summary), start_(std::chrono::steady_clock::now()) {
  context_.stage_ = std::move(name);
  context_.progress(0.0);
}

Stage::~Stage() {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  for (auto& [name, seconds] : summary_.seconds)
    if (name == context_.stage_) {
      seconds += elapsed.count();
      return;
    }
  summary_.seconds.emplace_back(context_.stage_, elapsed.count());
}

void parallel_blocks(const Context& context, std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  const auto guarded = [&](std::size_t begin, std::size_t end) {
    context.check();
    body(begin, end);
  };
  if (context.threads == 1 || count <= grain) {
    for (std::size_t begin = 0; begin < count; begin += grain) guarded(begin, std::min(begin + grain, count));
    return;
  }
  const auto run = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { guarded(range.begin(), range.end()); },
        tbb::simple_partitioner());
  };
  if (context.threads > 0) {
    tbb::task_arena(std::min(context.threads, tbb::info::default_concurrency())).execute(run);  // asked for more, TBB prints a warning
  } else {
    run();
  }
}

}  // namespace unseen
