// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/surfaces.h"
#include "report/usd_text.h"
#include "unseen/core/version.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

constexpr std::size_t kMostPoints = 50000;  ///< text takes some 35 bytes a point

/// Positions relative to `offset` and the box around them, which grows by `margin` on all sides.
void add_positions(UsdText& usd, const std::vector<Vec3>& world, const Vec3& offset, double margin) {
  Eigen::AlignedBox3f box;
  std::vector<Vec3f> stored;
  for (const Vec3& p : world) {
    stored.push_back((p - offset).cast<float>());
    box.extend(stored.back());
  }
  const Vec3f grow = Vec3f::Constant(static_cast<float>(margin));
  usd.line("float3[] extent = [" + tuple(Vec3f(box.min() - grow)) + ", " + tuple(Vec3f(box.max() + grow)) +
           "]");
  usd.line("point3f[] points = " + list(stored, tuple<Vec3f>));
}

void add_width(UsdText& usd, double width) {
  usd.primvar(fmt::format("float[] widths = [{}]", static_cast<float>(width)), "constant");
}

void add_plane(UsdText& usd, const planes::Arrangement& a, std::size_t p, const Surface& surface,
               const Vec3& offset) {
  const planes::ArrangedPlane& plane = a.planes[p];
  const bool is_line = surface.triangles.empty();
  usd.open(is_line ? "BasisCurves" : "Mesh", fmt::format("plane_{}", p));
  add_positions(usd, surface.vertices, offset, is_line ? a.scale / 2 : 0.0);
  if (is_line) {
    usd.line("uniform token type = \"linear\"");
    usd.line("int[] curveVertexCounts = [2]");
    add_width(usd, a.scale);
  } else {
    usd.line("uniform bool doubleSided = 1");
    usd.line("uniform token subdivisionScheme = \"none\"");
    usd.line("int[] faceVertexCounts = " + list(surface.triangles, [](const Triangle&) { return "3"; }));
    usd.line("int[] faceVertexIndices = " + list(surface.triangles, [](const Triangle& t) {
               return fmt::format("{}, {}, {}", t[0], t[1], t[2]);
             }));
  }
  usd.primvar("color3f[] primvars:displayColor = [" + color(frame_color(plane.frame)) + "]", "constant");
  if (!plane.tag.empty()) usd.line("custom string userProperties:tag = " + quoted(plane.tag));
  usd.close();
}

/// Mean distance of neighbouring points if they lie evenly on the planes, m; at most the scale, which it is
/// without planes, too.
double spacing_of(const planes::Arrangement& a, std::size_t points) {
  double size = 0;
  for (const planes::ArrangedPlane& plane : a.planes) size += plane.area;
  const double share = size / static_cast<double>(points);
  const double spacing = a.two_dimensional ? share : std::sqrt(share);
  return spacing > 0 ? std::min(spacing, a.scale) : a.scale;
}

void add_points(UsdText& usd, const planes::Arrangement& a, const PointSample& points, const Vec3& offset) {
  const PointSample few = thinned(points, kMostPoints);
  const double width = spacing_of(a, few.positions.size());
  std::vector<Rgb> colors = {plane_color(-1, -1)};  // entry p + 1 is plane p's
  for (std::size_t p = 0; p < a.planes.size(); ++p)
    colors.push_back(plane_color(static_cast<int>(p), a.planes[p].frame));
  usd.open("Points", "points");
  add_positions(usd, few.positions, offset, width / 2);
  add_width(usd, width);
  usd.primvar("color3f[] primvars:displayColor = " + list(colors, color), "vertex");
  usd.line("int[] primvars:displayColor:indices = " +
           list(few.plane_of_point, [](int plane) { return std::to_string(plane + 1); }));
  usd.close();
}

}  // namespace

std::string planes_usda(const planes::Arrangement& a, const PointSample& points) {
  const auto surfaces = surfaces_of(a);
  const Vec3 offset = offset_of(surfaces, points);
  UsdText usd(
      fmt::format("#usda 1.0\n(\n    defaultPrim = \"unseen\"\n    doc = \"planes of unseen {}\"\n"
                  "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n",
                  kVersion));
  usd.open("Xform", "unseen");
  usd.line("double3 xformOp:translate = " + tuple(offset));
  usd.line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
  usd.open("Xform", "planes");
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    usd.open("Xform", fmt::format("frame_{}", f));
    for (const int plane : a.frames[f].planes) {
      const auto p = static_cast<std::size_t>(plane);
      if (!surfaces[p].triangles.empty() || surfaces[p].vertices.size() == 2)
        add_plane(usd, a, p, surfaces[p], offset);
    }
    usd.close();
  }
  usd.close();
  if (!points.positions.empty()) add_points(usd, a, points, offset);
  usd.close();
  return usd.text();
}

}  // namespace unseen::report
