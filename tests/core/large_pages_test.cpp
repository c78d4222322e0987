// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "core/large_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <future>
#include <numeric>

namespace unseen {
namespace {

/// Bytes of address space that the process holds.
std::size_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return 4096 * pages;
}

/// Bytes of memory that the process holds.
std::size_t resident() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages >> pages;
  return 4096 * pages;
}

TEST(LargePages, KeepWhatAGrowingArrayHolds) {
  LargeVector<std::uint32_t> v;  // grows from small memory through several sizes of large memory
  for (std::uint32_t i = 0; i < 3'000'000; ++i) v.push_back(i);
  for (std::uint32_t i = 0; i < v.size(); ++i) ASSERT_EQ(v[i], i);
  const LargeVector<std::uint32_t> copy = v;
  EXPECT_EQ(copy, v);
}

TEST(LargePages, StartAtMultiplesOfTheirSize) {
  if (!has_large_pages()) GTEST_SKIP() << "the system has no large pages";
  for (const std::size_t bytes : {kLargestPart + 1, std::size_t{5'000'001}}) {
    const LargeVector<char> v(bytes, 'x');
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(v.data()) % (1 << 21), 0u);
    EXPECT_EQ(std::accumulate(v.begin(), v.end(), std::size_t{0}), bytes * 'x');
  }
}

TEST(LargePages, GoBackToTheSystem) {
  if (!has_large_pages()) GTEST_SKIP() << "the system has no large pages";
  const std::size_t before = address_space();
  for (int i = 0; i < 100; ++i) LargeVector<char>().reserve(50'000'000 + 12'345 * i);
  EXPECT_LT(address_space(), before + 60'000'000);
}

TEST(LargePages, PartsDoNotOverlapAndAreTakenAgain) {
  if (!has_large_pages()) GTEST_SKIP() << "the system has no large pages";
  std::size_t room = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<std::future<void>> all;
    for (int thread = 0; thread < 4; ++thread)
      all.push_back(std::async(std::launch::async, [thread, round] {
        std::vector<LargeVector<std::size_t>> arrays;
        for (std::size_t i = 0; i < 40; ++i) arrays.emplace_back(1000 + 777 * i, i + 100 * thread + 10'000 * round);
        for (std::size_t i = 0; i < arrays.size(); ++i)
          for (const std::size_t value : arrays[i]) ASSERT_EQ(value, i + 100 * thread + 10'000 * round);
      }));
    for (auto& one : all) one.get();
    if (round == 4) room = resident();
  }
  EXPECT_LT(resident(), room + 60'000'000);  // each round takes 21 MB
}

TEST(LargePages, TooMuchIsAnError) {
  EXPECT_THROW(LargePages<double>().allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
  if (!has_large_pages()) return;
  EXPECT_THROW(LargePages<double>().allocate(std::size_t{1} << 55), std::bad_alloc);
}

}  // namespace
}  // namespace unseen
