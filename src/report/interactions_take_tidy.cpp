// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/text.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using namespace interactions;

bool seen(const Detection& d) { return (d.confidence > 0.0).any(); }

void sort_by_frame(Take& take) {
  const auto earlier = [](const Detection& a, const Detection& b) { return a.frame < b.frame; };
  if (std::is_sorted(take.detections.begin(), take.detections.end(), earlier)) return;
  std::stable_sort(take.detections.begin(), take.detections.end(), earlier);
  take.remarks.push_back("the frames are out of order: sorted");
}

/// A tracker's names become 0, 1, … if there are no more of them than people; else they say little, and are dropped.
void number_people(Take& take) {
  std::map<int, int> numbers;
  for (const Detection& d : take.detections)
    if (d.person >= 0) numbers.emplace(d.person, 0);
  int next = 0;
  for (auto& [name, number] : numbers) number = next++;
  const bool few = next <= take.people;
  if (!few) take.remarks.push_back(fmt::format("a tracker's {} identities for {} are not used", next, io::count_of(static_cast<std::size_t>(take.people), take.people == 1 ? "person" : "people")));
  for (Detection& d : take.detections)
    if (d.person >= 0) d.person = few ? numbers[d.person] : -1;
}

/// Mean distance of the joints that both have, less than 2 % of the first's extent: the same person found twice.
bool nearly_identical(const Detection& a, const Detection& b) {
  constexpr double kNear = 0.02;
  constexpr int kEnough = 4;
  Vec2 low = Vec2::Constant(INFINITY), high = -low;
  double sum = 0;
  int joints = 0;
  for (int j = 0; j < kJoints; ++j) {
    if (!(a.confidence[j] > 0.0) || !(b.confidence[j] > 0.0)) continue;
    low = low.cwiseMin(a.pixels.col(j));
    high = high.cwiseMax(a.pixels.col(j));
    sum += (a.pixels.col(j) - b.pixels.col(j)).norm();
    ++joints;
  }
  return joints >= kEnough && sum <= kNear * joints * (high - low).norm();
}

/// Of detections in one frame that are the same, the more confident is kept; a person named twice is an error.
void join_identical(Take& take, const std::string& source) {
  std::vector<Detection> kept;
  std::size_t joined = 0, first = 0;
  for (const Detection& d : take.detections) {
    if (kept.empty() || kept.back().frame != d.frame) first = kept.size();
    bool again = false;
    for (std::size_t k = first; k < kept.size() && !again; ++k) {
      if (d.person >= 0 && kept[k].person == d.person)
        throw InputError(source, fmt::format("frame {}", d.frame), fmt::format("person {} twice", d.person), "each person once a frame");
      again = (d.person < 0 || kept[k].person < 0) && nearly_identical(kept[k], d);
      if (again && d.confidence.sum() > kept[k].confidence.sum()) kept[k] = d;
    }
    joined += again;
    if (!again) kept.push_back(d);
    if (kept.size() - first > kMostInFrame) throw InputError(source, fmt::format("frame {}", d.frame), "more people", fmt::format("at most {}", kMostInFrame));
  }
  take.detections = std::move(kept);
  if (joined > 0) take.remarks.push_back(fmt::format("{} nearly the same as another of the frame: joined", io::count_of(joined, "detection")));
}

}  // namespace

void tidy_detections(Take& take, const std::string& source) {
  std::erase_if(take.detections, [](const Detection& d) { return !seen(d); });
  if (take.detections.empty()) throw InputError(source, "", "no person in any frame", "the joints of somebody");
  sort_by_frame(take);
  number_people(take);
  join_identical(take, source);
}

}  // namespace unseen::report
