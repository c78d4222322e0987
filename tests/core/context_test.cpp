// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/context.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include "unseen/core/error.h"

namespace unseen {
namespace {

TEST(ParallelBlocks, EveryIndexOnceOnNoMoreThreadsThanAsked) {
  constexpr std::size_t kCount = 10'007, kGrain = 10;
  for (const int threads : {0, 1, 2}) {
    Context context;
    context.threads = threads;
    std::vector<int> times(kCount, 0);
    std::set<std::thread::id> seen;
    std::mutex guard;
    parallel_blocks(context, kCount, kGrain, [&](std::size_t begin, std::size_t end) {
      ASSERT_LE(end - begin, kGrain);
      for (std::size_t i = begin; i < end; ++i) ++times[i];
      const std::scoped_lock lock(guard);
      seen.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(times, std::vector<int>(kCount, 1)) << threads;
    EXPECT_LE(seen.size(), threads > 0 ? static_cast<std::size_t>(threads) : kCount);
  }
}

TEST(ParallelBlocks, OfNothingCallsNothing) {
  parallel_blocks({}, 0, 10, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(ParallelBlocks, EndWithTheNextBlockAfterAStop) {
  for (const int threads : {1, 2}) {
    std::stop_source source;
    Context context;
    context.threads = threads;
    context.stop = source.get_token();
    std::atomic<int> blocks = 0;
    EXPECT_THROW(parallel_blocks(context, 1000, 1, [&](std::size_t, std::size_t) { source.request_stop(), ++blocks; }), Cancelled);
    EXPECT_LE(blocks, threads) << "none starts after the stop, as many as threads may run at it";
  }
}

TEST(Stages, AddTheirTimeByNameAndReportUnderIt) {
  Context context;
  Summary summary;
  std::vector<std::string> heard;
  context.on_progress = [&](std::string_view stage, double fraction) { heard.push_back(std::string(stage) + (fraction > 0 ? " on" : "")); };
  for (int i = 0; i < 2; ++i) {
    const Stage stage(context, summary, "read");
    context.progress(0.5);
  }
  { const Stage stage(context, summary, "fit"); }
  EXPECT_EQ(heard, (std::vector<std::string>{"read", "read on", "read", "read on", "fit"}));
  ASSERT_EQ(summary.seconds.size(), 2u);
  EXPECT_EQ(summary.seconds[0].first, "read");
  EXPECT_GE(summary.seconds[0].second, 0.0);
}

TEST(Warnings, AreHeardAtOnceAndTakenOnce) {
  Context context;
  std::string heard;
  context.on_message = [&](std::string_view text) { heard = text; };
  context.warn("thin");
  EXPECT_EQ(heard, "warning: thin");
  EXPECT_EQ(context.take_warnings(), std::vector<std::string>{"thin"});
  EXPECT_TRUE(context.take_warnings().empty());
}

}  // namespace
}  // namespace unseen
