// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "unseen/report/planes_files.h"

namespace unseen::report {

std::vector<Surface> surfaces_of(const planes::Arrangement& arrangement) {
  std::vector<Surface> surfaces;
  for (const planes::ArrangedPlane& plane : arrangement.planes) {
    Surface& surface = surfaces.emplace_back();
    if (plane.segment) {
      surface.vertices = {(*plane.segment)[0], (*plane.segment)[1]};
      continue;
    }
    for (const auto& ring : plane.polygon)
      surface.vertices.insert(surface.vertices.end(), ring.begin(), ring.end());
    surface.triangles = triangulate(plane.polygon, plane.plane.normal);
  }
  return surfaces;
}

Vec3 offset_of(const std::vector<Surface>& surfaces, const PointSample& points) {
  Eigen::AlignedBox3d box;
  for (const Surface& s : surfaces)
    for (const Vec3& v : s.vertices) box.extend(v);
  for (const Vec3& p : points.positions) box.extend(p);
  if (box.isEmpty()) return Vec3::Zero();
  const double farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return farthest <= 8.0 * box.diagonal().norm() ? Vec3::Zero() : Vec3(box.center().array().round().matrix());
}

std::string plane_name(const planes::Arrangement& arrangement, std::size_t plane) {
  const std::string& tag = arrangement.planes[plane].tag;
  return "plane " + std::to_string(plane) + (tag.empty() ? "" : " (" + tag + ")");
}

}  // namespace unseen::report
