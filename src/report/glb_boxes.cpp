// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/glb_boxes.h"

#include "report/cuboid_parts.h"

namespace unseen::report {
namespace {

/// Faces outward; corners as corners_of() gives them.
constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

}  // namespace

tinygltf::Primitive boxes_primitive(GlbBuilder& b, const std::vector<OrientedBox>& boxes, int material) {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const OrientedBox& box : boxes) {
    const std::vector<Vec3> corners = corners_of(box);
    for (const auto& face : kFaces) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const std::uint32_t corner : face) vertices.push_back(corners[corner]);
      triangles.push_back({first, first + 1, first + 2});
      triangles.push_back({first, first + 2, first + 3});
    }
  }
  return b.surface(vertices, triangles, material);
}

}  // namespace unseen::report
