// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>

#include "planes/scan/even_sample.h"
#include "planes/scan/scale.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kMostSought = std::size_t{1} << 25;  // points among which duplicates are sought: 24 bytes each

std::uint64_t hash_of_normal(const PointCloud& cloud, std::size_t point) {
  return cloud.normals.empty() ? 0 : hash_of(cloud.normals[point].cast<double>());
}

/// Marks all but one of the points that share their coordinates (two places in 2⁶⁴ have the same hash). Which
/// one stays does not depend on the order of the points: the one whose normal has the smallest hash.
void find_duplicates(PointSource& source, Survey& survey) {
  struct Hashed {
    std::uint64_t position, normal;
    std::uint32_t point;
    auto operator<=>(const Hashed&) const = default;
  };
  LargeVector<Hashed> order;
  order.reserve(survey.finite);
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (block.positions[i].allFinite())
        order.push_back({hash_of(block.positions[i]), hash_of_normal(block, i), static_cast<std::uint32_t>(first + i)});
  });
  std::sort(order.begin(), order.end());
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].position != order[i - 1].position) continue;
    if (survey.duplicate.empty()) survey.duplicate.assign(survey.points, false);
    survey.duplicate[order[i].point] = true;
    ++survey.duplicates;
  }
}

/// The box that holds all but a hundredth of the sample at either end of each axis, grown on all sides by ten
/// times its longest edge. The sample is in the order of its hashes, so that its first points are as even as the whole.
Box neighbourhood(const LargeVector<Vec3>& sample) {
  constexpr double kAtEachEnd = 0.01, kFar = 10.0;
  constexpr std::size_t kTelling = 20'000;
  std::vector<double> along(std::min(sample.size(), kTelling));
  const auto rank = static_cast<std::ptrdiff_t>(kAtEachEnd * static_cast<double>(along.size()));
  Box box;
  for (int a = 0; a < 3; ++a) {
    std::transform(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(along.size()), along.begin(), [&](const Vec3& p) { return p[a]; });
    std::nth_element(along.begin(), along.begin() + rank, along.end());
    box.low[a] = along[rank];
    std::nth_element(along.begin(), along.end() - 1 - rank, along.end());
    box.high[a] = *(along.end() - 1 - rank);
  }
  const double margin = kFar * (box.high - box.low).maxCoeff();
  return {box.low.array() - margin, box.high.array() + margin};
}

/// No-data values and a few points that lie far from all others would stand for the size of the scene: the
/// box leaves them out, and then the sample speaks for the extent.
void leave_out_strays(Survey& s) {
  const Box box = neighbourhood(s.sample);
  if (box.contains(s.low) && box.contains(s.high)) return;
  s.within = box;
  s.low.setConstant(std::numeric_limits<double>::infinity());
  s.high = -s.low;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.sample.size(); ++i) {
    if (!box.contains(s.sample[i])) continue;
    s.low = s.low.cwiseMin(s.sample[i]);
    s.high = s.high.cwiseMax(s.sample[i]);
    if (s.has_normals()) s.sample_normals[kept] = s.sample_normals[i];
    s.sample[kept++] = s.sample[i];
  }
  s.sample.resize(kept);
  if (s.has_normals()) s.sample_normals.resize(kept);
}

/// Squares and cubes of lengths must be numbers.
void check_extent(const Survey& s, const std::string& name) {
  constexpr double kLongest = 1e75;  // m
  if (s.extent() < kLongest) return;
  throw InputError(name, "points",
                   fmt::format("coordinates from {} to {}", s.low.minCoeff(), s.high.maxCoeff()),
                   fmt::format("an extent below {} m", kLongest));
}

}  // namespace

Survey survey(PointSource& source, Context& context) {
  Survey s;
  s.low.setConstant(std::numeric_limits<double>::infinity());
  s.high = -s.low;
  const bool normals = source.info().has_normals;
  EvenSample sample(source.info().point_count.value_or(0));
  const double total = static_cast<double>(source.info().point_count.value_or(0));
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if ((i & 0xffff) == 0) context.progress(total > 0 ? std::min(1.0, (first + i) / total) : 0.0);
      const Vec3& p = block.positions[i];
      if (!p.allFinite()) continue;
      ++s.finite;
      s.low = s.low.cwiseMin(p);
      s.high = s.high.cwiseMax(p);
      const bool normal = normals && i < block.normals.size();
      if (normal) {
        const float length = block.normals[i].squaredNorm();
        if (!(length > 0.25f && length < 4.0f)) ++s.without_normal;
      }
      const std::uint64_t h = hash_of(p);
      if (sample.wants(h)) sample.add({h, p, normal ? block.normals[i] : Vec3f(Vec3f::Zero())});
    }
    s.points += block.size();
  });
  const bool twins = sample.twins(), no_duplicates = sample.has_all() && !twins;
  const LargeVector<Sampled> places = sample.by_hash();
  s.sample.reserve(places.size());
  if (normals) s.sample_normals.reserve(places.size());
  for (const Sampled& x : places) {
    s.sample.push_back(x.position);
    if (normals) s.sample_normals.push_back(x.normal);
  }
  if (s.finite == 0)
    throw InputError(source.info().name, "points",
                     s.points == 0 ? "none" : std::to_string(s.points) + ", none of them finite",
                     "at least three points that are not in a line");
  if (!no_duplicates && (source.cloud() != nullptr || (twins && s.points <= kMostSought)))
    find_duplicates(source, s);
  else if (twins)
    context.warn(
        fmt::format("some points are duplicates; among more than {} they are not sought", kMostSought));
  s.share = static_cast<double>(s.sample.size()) / static_cast<double>(s.finite - s.duplicates);
  leave_out_strays(s);
  check_extent(s, source.info().name);
  return s;
}

double rounding_of(const Survey& survey) {
  constexpr std::size_t kLooked = 2000;
  constexpr double kLeast = 1e-5, kExact = 1e-3;  // of the extent; of a step
  constexpr int kMostTimes = 9;
  constexpr double kMost = 0.01;  // of the extent: the corners of a box come in any step
  const std::size_t every = survey.sample.size() / kLooked + 1;
  const auto comes_in = [&](double step) {
    for (std::size_t i = 0; i < survey.sample.size(); i += every) {
      const Vec3 steps = (survey.sample[i] - survey.sample.front()) / step;
      if ((steps - steps.array().round().matrix()).cwiseAbs().maxCoeff() > kExact) return false;
    }
    return true;
  };
  for (double power = std::pow(10.0, std::floor(std::log10(survey.extent()))); power > kLeast * survey.extent(); power /= 10.0)
    for (const double part : {1.0, 0.5, 0.25})
      if (comes_in(part * power)) {
        int times = kMostTimes;  // centres of voxels of 3 cm come in steps of 1 cm too
        while (times > 1 && (times * part * power > kMost * survey.extent() || !comes_in(times * part * power))) --times;
        return times * part * power;
      }
  return 0.0;
}

}  // namespace unseen::planes
