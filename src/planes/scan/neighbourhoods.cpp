// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

/// A point and those found near it so far. No more than the nearest `most` count.
struct Gathering {
  struct Found {
    double squared;
    Vec3 point;
  };
  Vec3 center;
  double squared_radius;  ///< m², beyond which no point counts
  std::size_t most;
  std::vector<Found> found;

  void add(const Vec3& p) {
    const double squared = (p - center).squaredNorm();
    if (squared > squared_radius) return;
    found.push_back({squared, p});
    if (found.size() == 8 * most) keep_nearest();
  }
  void keep_nearest() {
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
      return std::tie(a.squared, a.point.x(), a.point.y(), a.point.z()) <
             std::tie(b.squared, b.point.x(), b.point.y(), b.point.z());
    });
    const auto same = [](const Found& a, const Found& b) { return a.point == b.point; };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    if (found.size() < most) return;
    found.resize(most);
    squared_radius = found.back().squared;  // those just as far may still come
  }
};

/// Finds gatherings by the cells of a grid that they reach.
class Cover {
 public:
  Cover(const std::vector<Gathering>& gatherings, const Vec3& origin, double edge)
      : origin_(origin), edge_(edge) {
    for (std::size_t i = 0; i < gatherings.size(); ++i) {
      const Vec3 reach = Vec3::Constant(std::sqrt(gatherings[i].squared_radius));
      const VoxelKey low = key_of(gatherings[i].center - reach), high = key_of(gatherings[i].center + reach);
      VoxelKey k;
      for (k[0] = low[0]; k[0] <= high[0]; ++k[0])
        for (k[1] = low[1]; k[1] <= high[1]; ++k[1])
          for (k[2] = low[2]; k[2] <= high[2]; ++k[2]) {
            const std::size_t cell = table_.insert(k);
            reaching_.resize(table_.keys().size());
            reaching_[cell].push_back(i);
          }
    }
  }
  std::span<const std::size_t> at(const Vec3& p) const {
    const int cell = table_.find(key_of(p));
    if (cell < 0) return {};
    return reaching_[static_cast<std::size_t>(cell)];
  }

 private:
  VoxelKey key_of(const Vec3& p) const {
    const Vec3 cell = ((p - origin_) / edge_).array().floor();
    return {static_cast<std::int32_t>(cell.x()), static_cast<std::int32_t>(cell.y()),
            static_cast<std::int32_t>(cell.z())};
  }

  Vec3 origin_;
  double edge_;
  KeyTable table_;
  std::vector<std::vector<std::size_t>> reaching_;
};

/// The nearest points that a search has found so far, as a heap: in a sorted list, each of some hundred would move half of the others.
class Nearest {
 public:
  using DistanceType = double;

  explicit Nearest(std::size_t most) : most_(most) { found_.reserve(most); }
  std::size_t size() const { return found_.size(); }
  bool full() const { return found_.size() == most_; }
  /// What is nearer than this is added: also what is just as far, as its place in the sample decides.
  double worstDist() const {
    constexpr double kFarthest = std::numeric_limits<double>::infinity();
    return full() ? std::nextafter(found_.front().first, kFarthest) : kFarthest;
  }
  bool addPoint(double squared, std::uint32_t index) {
    if (full()) {
      if (std::pair{squared, index} > found_.front()) return true;
      std::pop_heap(found_.begin(), found_.end());
      found_.pop_back();
    }
    found_.emplace_back(squared, index);
    std::push_heap(found_.begin(), found_.end());
    return true;
  }
  /// By rising distance.
  std::vector<std::pair<double, std::uint32_t>> sorted() && {
    std::sort_heap(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  std::size_t most_;
  std::vector<std::pair<double, std::uint32_t>> found_;
};

}  // namespace

Neighbourhood SampleTree::around(std::size_t probe, std::size_t points) const {
  Nearest nearest(points);
  tree_.find(points_[probe], nearest);
  Neighbourhood result;
  for (const auto& [squared, i] : std::move(nearest).sorted()) result.push_back(points_[i]);
  return result;
}

std::vector<Neighbourhood> neighbourhoods(PointSource& source, const Survey& survey, const SampleTree& tree,
                                          std::size_t probes, std::size_t points, const Context& context) {
  constexpr double kAmple = 1.5, kFarthest = 8.0, kFinest = 1e-6;  // the last: of the extent
  const auto enclosing =
      static_cast<std::size_t>(std::max(3.0, kAmple * static_cast<double>(points) * survey.share));
  std::vector<double> radii(std::min(probes, survey.sample.size()));
  parallel_blocks(context, radii.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      radii[i] = (tree.around(i, enclosing + 1).back() - survey.sample[i]).norm();
  });
  const double typical = std::max(median(radii), kFinest * survey.extent());
  std::vector<Gathering> gatherings;
  for (std::size_t i = 0; i < radii.size(); ++i)
    gatherings.push_back(
        {survey.sample[i], radii[i] <= kFarthest * typical ? radii[i] * radii[i] : 0.0, points, {}});
  const Cover cover(gatherings, survey.low, 2.0 * typical);
  for_each_block(source, [&](const PointCloud& block, std::size_t) {
    context.check();
    for (const Vec3& p : block.positions)
      if (survey.within.contains(p))
        for (const std::size_t i : cover.at(p)) gatherings[i].add(p);
  });
  std::vector<Neighbourhood> result(gatherings.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    gatherings[i].keep_nearest();
    for (const auto& f : gatherings[i].found) result[i].push_back(f.point);
  }
  return result;
}

}  // namespace unseen::planes
