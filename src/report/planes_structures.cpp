// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/planes_structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

using planes::Arrangement;

/// Plane fitted freely to points: what the data alone say; `fallback` where they say little or something else.
Plane free_fit(std::span<const Vec3> points, const Plane& fallback, std::optional<int> flat) {
  if (points.size() < 8) return fallback;
  const Plane fit = fitted_plane(points, flat);
  const double cosine = fit.normal.dot(fallback.normal);
  if (std::abs(cosine) < 0.5) return fallback;
  return cosine > 0 ? fit : Plane{-fit.normal, -fit.offset};
}

/// Where a vertex of a plane lies on another one, along the plane's own normal.
Vec3 carried(const Vec3& vertex, const Vec3& along, const Plane& to) {
  return vertex - to.signed_distance(vertex) / to.normal.dot(along) * along;
}

std::vector<std::string> numbered(std::string_view name, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("{} {}", name, i));
  return names;
}

std::vector<std::string> plane_names(const Arrangement& a) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < a.planes.size(); ++p) names.push_back(plane_name(a, p));
  return names;
}

/// The quantities that planes and lines share.
Json plane_quantities(SceneBuilder& scene, const Arrangement& a) {
  std::vector<int> frames, directions, own;
  std::vector<float> rms;
  for (std::size_t p = 0; p < a.planes.size(); ++p) {
    frames.push_back(a.planes[p].frame);
    directions.push_back(a.planes[p].direction);
    own.push_back(static_cast<int>(p));
    rms.push_back(static_cast<float>(a.planes[p].rms));
  }
  Json frame = quantity("frame", "Orientation frame", "label", scene.integers(frames));
  frame["names"] = numbered("frame", a.frames.size());
  Json direction = quantity("direction", "Direction (parallel)", "label", scene.integers(directions));
  direction["names"] = numbered("direction", a.directions.size());
  Json plane = quantity("plane", a.two_dimensional ? "Line" : "Plane", "label", scene.integers(own));
  plane["names"] = plane_names(a);
  Json residual = quantity("rms", "RMS distance of its points", "scalar", scene.scalars(rms), a.two_dimensional ? "" : "m");
  residual["low"] = 0.0;
  residual["high"] = number(rms.empty() ? a.scale : std::max(1e-9, static_cast<double>(*std::max_element(rms.begin(), rms.end()))));
  return {frame, direction, plane, residual};
}

/// The planes of each direction.
std::vector<std::vector<int>> planes_of_directions(const Arrangement& a) {
  std::vector<std::vector<int>> members(a.directions.size());
  for (std::size_t p = 0; p < a.planes.size(); ++p) members[a.planes[p].direction].push_back(static_cast<int>(p));
  return members;
}

}  // namespace

void add_surfaces(SceneBuilder& scene, const Arrangement& a, const std::vector<Surface>& surfaces, const OrderedPoints& points) {
  std::vector<Vec3> vertices, before, normals;
  std::vector<std::array<int, 2>> rings;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> owner;
  const std::optional<int> flat = planes::flat_axis(a);
  for (std::size_t p = 0; p < a.planes.size(); ++p) {
    const planes::ArrangedPlane& plane = a.planes[p];
    const Plane fit = free_fit(points.of_plane(static_cast<int>(p)), plane.plane, flat);
    const int first = static_cast<int>(vertices.size());
    int ring_start = first;
    for (const auto& ring : plane.polygon) {
      rings.push_back({ring_start, static_cast<int>(p)});
      ring_start += static_cast<int>(ring.size());
    }
    for (const Vec3& v : surfaces[p].vertices) {
      vertices.push_back(v);
      before.push_back(carried(v, plane.plane.normal, fit));
    }
    for (const Triangle& t : surfaces[p].triangles) {
      triangles.push_back({first + static_cast<int>(t[0]), first + static_cast<int>(t[1]), first + static_cast<int>(t[2])});
      owner.push_back(static_cast<int>(p));
    }
    normals.push_back(plane.plane.normal);
  }
  Json quantities = plane_quantities(scene, a);
  Json& structure = a.two_dimensional ? scene.add("lines", "planes", "Lines") : scene.add("planes", "planes", "Planes");
  structure["vertices"] = scene.positions(vertices);
  if (!points.positions.empty()) structure["before"] = scene.positions(before);
  if (!a.two_dimensional) {
    structure["rings"] = scene.pairs(rings);
    structure["triangles"] = scene.triples(triangles);
    structure["triangle_plane"] = scene.integers(owner);
    structure["normals"] = scene.vectors(normals);
  }
  structure["quantities"] = std::move(quantities);
}

void add_points(SceneBuilder& scene, const Arrangement& a, const OrderedPoints& points) {
  std::vector<int> frames;
  std::vector<float> residuals;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const int p = points.plane[i];
    frames.push_back(p < 0 ? -1 : a.planes[p].frame);
    residuals.push_back(p < 0 ? 0.0f : static_cast<float>(std::abs(a.planes[p].plane.signed_distance(points.positions[i]))));
  }
  Json& cloud = scene.add("points", "points", "Points");
  cloud["positions"] = scene.point_positions(points.positions);
  Json frame = quantity("frame", "Orientation frame", "label", scene.integers(frames));
  frame["names"] = numbered("frame", a.frames.size());
  Json plane = quantity("plane", a.two_dimensional ? "Line" : "Plane", "label", scene.integers(points.plane));
  plane["structure"] = "planes";
  Json residual = quantity("residual", "Distance to its plane", "scalar", scene.coarse_scalars(residuals, 0.0, a.scale), a.two_dimensional ? "" : "m");
  residual["low"] = 0.0;
  residual["high"] = number(a.scale);
  cloud["quantities"] = {frame, plane, residual};
}

/// Directions as nodes, relations as edges.
void add_relations(SceneBuilder& scene, const Arrangement& a) {
  std::vector<int> frames;
  for (const planes::Direction& d : a.directions) frames.push_back(d.frame);
  std::vector<std::array<int, 2>> edges;
  std::vector<std::string> names;
  for (const planes::Relation& r : a.relations) {
    edges.push_back({r.a, r.b});
    names.push_back(fmt::format("{:.4g}°", degrees(r.angle)));
  }
  Json& graph = scene.add("graph", "relations", "Relations of directions");
  graph["node_names"] = numbered("direction", a.directions.size());
  graph["edge_names"] = names;
  graph["edges"] = scene.pairs(edges);
  graph["elements"] = {{"structure", "planes"}, {"of_node", planes_of_directions(a)}};
  Json frame = quantity("frame", "Frame", "label", scene.integers(frames));
  frame["names"] = numbered("frame", a.frames.size());
  graph["quantities"].push_back(frame);
}

void add_normals(SceneBuilder& scene, const Arrangement& a, const OrderedPoints& points) {
  std::vector<Vec3> after;
  std::vector<float> weights;
  const std::vector<std::vector<int>> members = planes_of_directions(a);
  double largest = 0;
  for (std::size_t d = 0; d < a.directions.size(); ++d) {
    double area = 0;
    for (const int p : members[d]) area += a.planes[p].area;
    after.push_back(a.directions[d].normal);
    weights.push_back(static_cast<float>(area));
    largest = std::max(largest, area);
  }
  for (float& w : weights) w = largest > 0 ? static_cast<float>(w / largest) : 0.0f;
  Json& sphere = scene.add("normals", "normals", "Normals");
  sphere["before"] = scene.vectors(local_normals(points, planes::flat_axis(a)));
  sphere["after"] = scene.vectors(after);
  sphere["weights"] = scene.scalars(weights);
  sphere["elements"] = {{"structure", "planes"}, {"of_node", members}};
}

}  // namespace unseen::report
