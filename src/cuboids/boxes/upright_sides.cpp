// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/upright_sides.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "cuboids/boxes/box_axes.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kSliver = 0.7;       // spacings: the standard deviation of two rows of pixels is less, of three more
constexpr double kOffPlane = 0.003;   // m: how far the middle of a face may be off a plane that it lies on, or one deviation of a measurement …
const double kAlike = std::cos(radians(20.0));  // … and how far its own direction, of which noise leaves little

/// Whether a face is no more than two rows of pixels wide.
bool is_sliver(const Observation& seen, const Face& face) {
  std::vector<float> spacings;
  for (const int i : face.points) spacings.push_back(seen.graph.spacing[i]);
  return face.width < kSliver * median(std::move(spacings));
}

/// Whether a face lies on a side's plane, as far as noise tells.
bool lies_on(const Observation& seen, const Face& side, const Face& face) {
  const double tolerance = std::max<double>(seen.graph.sigma[face.points[face.points.size() / 2]], kOffPlane);
  return side.plane.normal.dot(face.plane.normal) > kAlike && std::abs(side.plane.signed_distance(face.center)) < tolerance;
}

/// The upright plane of least squared distances to a side's points.
void fit_upright(const Observation& seen, Face& side) {
  const double count = static_cast<double>(side.points.size());
  side.center.setZero();
  for (const int i : side.points) side.center += seen.points[i] / count;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const int i : side.points) {
    const Vec2 off = (seen.points[i] - side.center).head<2>();
    second += off * off.transpose();
  }
  Vec3 normal = Vec3::Zero();
  normal.head<2>() = symmetric_eigen<2>(second).vectors.col(0);
  if (normal.dot(side.plane.normal) < 0.0) normal = -normal;
  side.plane = {normal, normal.dot(side.center)};
}

}  // namespace

std::vector<Face> upright_sides(const Observation& seen, std::span<const Face* const> faces) {
  std::vector<const Face*> left;
  for (const Face* face : faces)
    if (std::abs(face->plane.normal.z()) <= kUprightSine && !is_sliver(seen, *face)) left.push_back(face);
  std::stable_sort(left.begin(), left.end(), [](const Face* a, const Face* b) { return a->points.size() > b->points.size(); });
  std::vector<Face> sides;
  while (!left.empty()) {
    Face side = *left.front();
    const Vec3 normal = Vec3(side.plane.normal.x(), side.plane.normal.y(), 0.0).normalized();
    side.plane = {normal, normal.dot(side.center)};
    left.erase(left.begin());
    for (std::size_t before = 0; before != side.points.size();) {
      before = side.points.size();
      std::erase_if(left, [&](const Face* face) {
        if (!lies_on(seen, side, *face)) return false;
        side.points.insert(side.points.end(), face->points.begin(), face->points.end());
        return true;
      });
      if (before != side.points.size()) fit_upright(seen, side);
    }
    sides.push_back(std::move(side));
  }
  return sides;
}

}  // namespace unseen::cuboids
