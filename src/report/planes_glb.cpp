// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/glb_builder.h"
#include "report/surfaces.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

tinygltf::Primitive surface_primitive(GlbBuilder& b, const Surface& surface, int frame) {
  if (!surface.triangles.empty()) return b.surface(surface.vertices, surface.triangles, frame);
  tinygltf::Primitive line;
  line.mode = TINYGLTF_MODE_LINE;
  line.material = frame;
  line.attributes["POSITION"] = b.add_positions(surface.vertices);
  return line;
}

std::vector<Rgb> point_colors(const planes::Arrangement& a, const PointSample& points) {
  std::vector<Rgb> colors;
  for (const int plane : points.plane_of_point)
    colors.push_back(plane_color(plane, plane < 0 ? -1 : a.planes[static_cast<std::size_t>(plane)].frame));
  return colors;
}

}  // namespace

std::string planes_glb(const planes::Arrangement& a, const PointSample& points) {
  const auto surfaces = surfaces_of(a);
  GlbBuilder b(offset_of(surfaces, points));
  for (std::size_t f = 0; f < a.frames.size(); ++f)
    b.add_material("frame " + std::to_string(f), frame_color(static_cast<int>(f)));
  for (std::size_t p = 0; p < surfaces.size(); ++p)
    if (!surfaces[p].triangles.empty() || surfaces[p].vertices.size() == 2)
      b.add_node(plane_name(a, p), surface_primitive(b, surfaces[p], a.planes[p].frame));
  if (!points.positions.empty()) b.add_points("points", points.positions, point_colors(a, points));
  return b.finish();
}

}  // namespace unseen::report
