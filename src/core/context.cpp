// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/context.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

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

#if defined(__SANITIZE_THREAD__)
namespace {

/// ThreadSanitizer does not see how TBB hands over work, as that is not compiled for it: blocks on threads that it sees.
void run_on_own_threads(std::size_t threads, std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    try {
      for (std::size_t begin; (begin = next.fetch_add(grain)) < count;) body(begin, std::min(begin + grain, count));
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t t = 1; t < threads; ++t) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace
#endif

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
#if defined(__SANITIZE_THREAD__)
  run_on_own_threads(static_cast<std::size_t>(context.threads > 0 ? context.threads : tbb::info::default_concurrency()), count, grain, guarded);
#else
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
#endif
}

}  // namespace unseen
