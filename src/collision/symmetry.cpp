// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/symmetry.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr double kTolerance = 1e-4;  // of the largest distance from the origin

/// Points by their distance from the origin; those within the tolerance of each other are in one class.
std::vector<std::vector<Vec3>> classes_of(std::vector<Vec3> points, double tolerance) {
  std::stable_sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
  std::vector<std::vector<Vec3>> classes;
  for (const Vec3& p : points) {
    if (classes.empty() || p.norm() - classes.back().back().norm() > tolerance) classes.emplace_back();
    classes.back().push_back(p);
  }
  return classes;
}

/// Points that can be looked up.
class PointSet {
 public:
  PointSet(std::vector<Vec3> points, double tolerance) : points_(std::move(points)), tolerance_(tolerance) {
    std::sort(points_.begin(), points_.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  }
  bool has(const Vec3& p) const {
    auto at = std::lower_bound(points_.begin(), points_.end(), p.x() - tolerance_, [](const Vec3& a, double x) { return a.x() < x; });
    for (; at != points_.end() && at->x() <= p.x() + tolerance_; ++at)
      if ((*at - p).norm() <= tolerance_) return true;
    return false;
  }
  bool is_mapped_to_itself(const Mat3& R) const {
    return std::all_of(points_.begin(), points_.end(), [&](const Vec3& p) { return has(R * p); });
  }

 private:
  std::vector<Vec3> points_;
  double tolerance_;
};

Mat3 frame_of(const Vec3& a, const Vec3& b) {
  Mat3 axes;
  axes.col(0) = a.normalized();
  axes.col(2) = a.cross(b).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

bool is_new(const Mat3& R, const std::vector<Mat3>& known) {
  return std::none_of(known.begin(), known.end(), [&](const Mat3& k) { return (k - R).norm() < 0.01; });
}

}  // namespace

std::vector<Mat3> rotations_of(const std::vector<Vec3>& points) {
  constexpr std::size_t kMost = 10'000;  // pairs: a rounder body than that is taken to have no turns of its own
  std::vector<Mat3> rotations = {Mat3::Identity()};
  double reach = 0.0;
  for (const Vec3& p : points) reach = std::max(reach, p.norm());
  const double tolerance = kTolerance * reach;
  std::vector<std::vector<Vec3>> classes = classes_of(points, tolerance);
  std::erase_if(classes, [&](const auto& c) { return c.front().norm() < 0.1 * reach; });
  std::stable_sort(classes.begin(), classes.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  // Two points that span a plane with the origin can only go to pairs of their own classes, which then tell the rotation.
  if (classes.empty()) return rotations;
  const Vec3 a = classes[0].front();
  for (const auto& seconds : classes) {
    const auto b = std::find_if(seconds.begin(), seconds.end(), [&](const Vec3& p) { return line_angle(a, p) > 0.1; });
    if (b == seconds.end()) continue;
    if (classes[0].size() * seconds.size() > kMost) return rotations;
    const PointSet set(points, 4.0 * tolerance);
    const Mat3 from = frame_of(a, *b);
    for (const Vec3& to_a : classes[0])
      for (const Vec3& to_b : seconds) {
        if (std::abs((to_a - to_b).norm() - (a - *b).norm()) > 4.0 * tolerance) continue;
        const Mat3 R = frame_of(to_a, to_b) * from.transpose();
        if (is_new(R, rotations) && set.is_mapped_to_itself(R)) rotations.push_back(R);
      }
    return rotations;
  }
  return rotations;
}

}  // namespace unseen::collision
