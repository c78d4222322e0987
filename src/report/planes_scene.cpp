// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "report/planes_structures.h"

namespace unseen::report {
namespace {

using planes::Arrangement;

/// Offsets are those in the page's coordinates: of world coordinates far away, normals have too few digits to go with them.
void add_table(SceneBuilder& scene, const Arrangement& a, const Vec3& shift) {
  const bool flat = a.two_dimensional;
  const int left_out = flat ? planes::flat_axis(a).value_or(2) : -1;  // of the normals of a drawing
  Json rows = Json::array();
  for (std::size_t p = 0; p < a.planes.size(); ++p) {
    const planes::ArrangedPlane& plane = a.planes[p];
    const Vec3& n = plane.plane.normal;
    Json row = Json::array();
    row.push_back(p);
    if (!flat) row.push_back(plane.tag);
    row.push_back(number(plane.area));
    row.push_back(plane.points);
    row.push_back(number(flat ? plane.rms : 1000.0 * plane.rms));
    row.push_back(number(degrees(plane.turned)));
    row.push_back(number(degrees(plane.turned_error)));
    row.push_back(plane.frame);
    row.push_back(plane.direction);
    for (int axis = 0; axis < 3; ++axis)
      if (axis != left_out) row.push_back(number(n[axis]));
    row.push_back(number(plane.plane.offset - n.dot(shift)));
    rows.push_back(std::move(row));
  }
  Json columns = Json::array();
  columns.push_back(column(flat ? "line" : "plane"));
  if (!flat) columns.push_back(column("tag"));
  columns.push_back(column(flat ? "length" : "area", flat ? "" : "m²", 3));
  columns.push_back(column("points"));
  columns.push_back(column("rms", flat ? "" : "mm", flat ? -1 : 2));  // four digits of a drawing's
  columns.push_back(column("turned", "°", 2));
  columns.push_back(column("±", "°", 2));
  columns.push_back(column("frame"));
  columns.push_back(column("direction"));
  for (int axis = 0; axis < 3; ++axis)
    if (axis != left_out) columns.push_back(column(fmt::format("normal {}", "xyz"[axis]), "", 4));
  columns.push_back(column(shift.isZero() ? "offset" : "offset, from the page's origin", flat ? "" : "m", 3));
  scene.header["tables"].push_back(
      {{"title", flat ? "Lines" : "Planes"},
       {"structure", "planes"},
       {"columns", std::move(columns)},
       {"rows", std::move(rows)}});
}

/// "1 704 875", with narrow no-break spaces.
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) text.insert(static_cast<std::size_t>(at), "\u202f");
  return text;
}

void add_facts(SceneBuilder& scene, const Arrangement& a) {
  const std::size_t points = count_of(a.summary, "points"), assigned = count_of(a.summary, "assigned");
  const std::string things = a.two_dimensional ? "lines" : "planes";
  add_fact(scene, things, std::to_string(a.planes.size()));
  add_fact(scene, "orientation frames", std::to_string(a.frames.size()), "Sets of directions at exact angles to each other. What stands askew has a frame of its own, and so has each strip of a curved surface");
  add_fact(scene, "directions", std::to_string(a.directions.size()), fmt::format("Exactly parallel {} share one", things));
  add_fact(scene, "relations", std::to_string(a.relations.size()), "Exact angles between directions. Each holds to 0.01°");
  add_fact(scene, "related pairs of " + things, grouped(a.plane_relations), fmt::format("Pairs of {} that these relations hold between", things));
  add_fact(scene, "points", grouped(points));
  add_fact(scene, "points explained", points > 0 ? fmt::format("{:.1f} %", 100.0 * static_cast<double>(assigned) / static_cast<double>(points)) : "–",
           fmt::format("Share of the points that lie on one of the {}", things));
  add_fact(scene, "scale", fmt::format("{:.4g}{}", a.scale, a.two_dimensional ? "" : " m"), "What is smaller than this is not told apart from noise");
}

std::string about(const Arrangement& a) {
  const std::string_view things = a.two_dimensional ? "lines" : "planes";
  return fmt::format("The {} that the points lie on. Angles that agree within the noise of the points are made exact; what differs by more is left as it is. Equal steps "
                     "and lengths are listed, not enforced. What is smaller than a few times the scale has no {}.", things, things.substr(0, things.size() - 1));
}

/// The box that all but half a percent of the points on planes lie in, along each axis and at each end.
std::optional<Json> focus_of(const OrderedPoints& points, const Vec3& offset) {
  const std::size_t first = points.first.front(), count = points.positions.size() - first;
  if (count < 1000) return std::nullopt;
  const std::size_t left_out = count / 200;
  Vec3 low, high;
  std::vector<double> values(count);
  for (int a = 0; a < 3; ++a) {
    for (std::size_t i = 0; i < count; ++i) values[i] = points.positions[first + i][a] - offset[a];
    const auto end = [&](std::size_t rank) {
      const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
      std::nth_element(values.begin(), at, values.end());
      return *at;
    };
    low[a] = end(left_out);
    high[a] = end(count - 1 - left_out);
  }
  return Json{{"low", vector_of(low)}, {"high", vector_of(high)}};
}

/// Whether the scene is a room seen from inside; nothing if its tags do not tell.
std::optional<bool> is_inside(const Arrangement& a) {
  const auto has = [&](std::string_view tag) {
    return std::any_of(a.planes.begin(), a.planes.end(), [&](const auto& plane) { return plane.tag == tag; });
  };
  if (!has("wall") && !has("floor")) return std::nullopt;
  return has("floor") && has("ceiling");
}

}  // namespace

std::string planes_scene(const Arrangement& a, const InputRecord& input, const OptionTable& options,
                         const std::string& command, const PointSample& sample) {
  const std::vector<Surface> surfaces = surfaces_of(a);
  const OrderedPoints points = ordered(sample, a.planes.size());
  const Vec3 offset = offset_of(surfaces, sample);
  SceneBuilder scene(offset);
  Json& header = scene.header;
  header["title"] = planes_title(a, input);
  write_run(scene, "planes", command, a.summary, options, input);
  if (a.planes.empty()) header["verdict"] = a.two_dimensional ? "no line was found" : "no plane was found: a smaller or larger --scale may help";
  header["flat"] = planes::flat_axis(a) == 2;  // the page looks at it from above
  if (const auto focus = focus_of(points, offset)) header["focus"] = *focus;
  if (const auto inside = is_inside(a)) header["inside"] = *inside;
  header["about"] = about(a);
  add_facts(scene, a);
  if (sample.step > 1) header["thinned"] = {{"shown", sample.positions.size()}, {"of", sample.seen}};
  add_surfaces(scene, a, surfaces, points);
  if (!points.positions.empty()) add_points(scene, a, points);
  add_relations(scene, a);
  add_normals(scene, a, points);
  add_table(scene, a, offset);
  return scene.encode();
}

std::string planes_title(const Arrangement& a, const InputRecord& input) {
  const std::string name = std::filesystem::path(input.path).filename().string();
  return (a.two_dimensional ? "Lines of " : "Planes of ") + (name.empty() ? input.path : name);
}

}  // namespace unseen::report
