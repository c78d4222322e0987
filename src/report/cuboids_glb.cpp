// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/cuboid_parts.h"
#include "report/glb_boxes.h"
#include "unseen/report/cuboids_files.h"

namespace unseen::report {
namespace {

constexpr std::size_t kMostPoints = 200'000;
constexpr double kHidden = 0.35;  ///< opacity of what was inferred
constexpr double kSupport = 0.6;  ///< of supports: things may stand behind a wall
constexpr Rgb kSupportColor = {200, 200, 195};

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

void add_support(GlbBuilder& b, const std::string& name, const std::vector<Vec3>& polygon) {
  Triangles triangles;
  for (std::uint32_t k = 2; k < polygon.size(); ++k) triangles.push_back({0, k - 1, k});  // outlines are convex
  b.add_node(name, b.surface(polygon, triangles, b.add_material(name, kSupportColor, kSupport)));
}

}  // namespace

std::string cuboids_glb(const cuboids::Completion& c, const RgbdFrame& frame) {
  GlbBuilder b(Vec3::Zero());
  for (const cuboids::Support& support : c.supports) add_support(b, name_of(support), polygon_of(support, c));
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
    const std::string name = name_of(c.cuboids[i]);
    const Rgb color = frame_color(static_cast<int>(i));
    if (!seen_part(c.cuboids[i]).is_empty())
      b.add_node(name + ", seen", boxes_primitive(b, {seen_box(c.cuboids[i])}, b.add_material(name, color)));
    if (const auto hidden = hidden_boxes(c.cuboids[i]); !hidden.empty())
      b.add_node(name + ", hidden", boxes_primitive(b, hidden, b.add_material(name + ", hidden", color, kHidden)));
  }
  const DepthPoints points = depth_points(frame, c.T_world_camera, kMostPoints);
  if (points.positions.empty()) return b.finish();
  std::vector<Rgb> colors(points.colors.begin(), points.colors.end());
  if (colors.empty())
    for (const int owner : cuboid_of_point(points.positions, c.cuboids)) colors.push_back(frame_color(owner));
  b.add_points("points", points.positions, colors);
  return b.finish();
}

}  // namespace unseen::report
