// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "report/polygon_size.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

/// A field of RFC 4180: in quotes if it needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

/// The shortest text that reads back as the same number; no "-0".
std::string field(double value) {
  return fmt::format("{}", value + 0.0);
}

template <class Integer>
requires std::is_integral_v<Integer> std::string field(Integer value) {
  return fmt::format("{}", value);
}

template <class... Values>
std::string row(const Values&... values) {
  std::string text;
  ((text += field(values) + ","), ...);
  text.pop_back();
  return text + "\r\n";
}

std::string plane_rows(const planes::Arrangement& a) {
  std::string text =
      row("id", "tag", "frame", "direction", "normal_x", "normal_y", "normal_z", "offset_m", "area_m2",
          "perimeter_m", "width_m", "height_m", "holes", "hole_area_m2", "points", "rms_m");
  for (std::size_t id = 0; id < a.planes.size(); ++id) {
    const planes::ArrangedPlane& p = a.planes[id];
    const Vec3& n = p.plane.normal;
    const PolygonSize size = polygon_size(p);
    text += row(id, p.tag, p.frame, p.direction, n.x(), n.y(), n.z(), p.plane.offset, p.area, size.perimeter,
                size.width, size.height, size.holes, size.hole_area, p.points, p.rms);
  }
  return text;
}

std::string line_rows(const planes::Arrangement& a) {
  const auto [right, up] = planes::drawing_axes(a);
  const char x = "xyz"[right], y = "xyz"[up];
  const auto named = [](const char* name, char axis, const char* unit) { return fmt::format("{}_{}{}", name, axis, unit); };
  std::string text = row("id", "tag", "frame", "direction", named("normal", x, ""), named("normal", y, ""), "offset_m", "length_m",
                         named("start", x, "_m"), named("start", y, "_m"), named("end", x, "_m"), named("end", y, "_m"), "points", "rms_m");
  for (std::size_t id = 0; id < a.planes.size(); ++id) {
    const planes::ArrangedPlane& p = a.planes[id];
    if (!p.segment) continue;
    const auto& [start, end] = *p.segment;
    const Vec3& n = p.plane.normal;
    text += row(id, p.tag, p.frame, p.direction, n[right], n[up], p.plane.offset, p.area, start[right], start[up], end[right], end[up], p.points, p.rms);
  }
  return text;
}

}  // namespace

std::string planes_csv(const planes::Arrangement& arrangement) {
  return arrangement.two_dimensional ? line_rows(arrangement) : plane_rows(arrangement);
}

}  // namespace unseen::report
