// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/planes/types.h"

namespace unseen::report {

/// A rectangle with the given half sides around `center`, counter-clockwise seen from the tip of `normal`.
inline std::vector<Vec3> rectangle(const Vec3& center, const Vec3& normal, double half_u, double half_v) {
  const Vec3 u = any_orthogonal(normal), v = normal.cross(u);
  return {center - half_u * u - half_v * v, center + half_u * u - half_v * v,
          center + half_u * u + half_v * v, center - half_u * u + half_v * v};
}

/// A room's corner by hand: floor with a hole, two walls, and a lone tilted plane in a frame of its own.
/// Everything moved by `offset`.
inline planes::Arrangement sample_room(const Vec3& offset = Vec3::Zero()) {
  planes::Arrangement a;
  a.scale = 0.05;
  a.angles = {radians(60.0), radians(90.0)};
  a.lambda = 0.25;
  a.directions = {{Vec3::UnitZ(), 0}, {Vec3::UnitX(), 0}, {Vec3::UnitY(), 0}, {Vec3(1, 2, 2) / 3.0, 1}};
  a.frames = {{{0, 1, 2}, {0, 1, 2, 3}}, {{3}, {4}}};
  const auto add = [&](int direction, double sign, const Vec3& center, const std::string& tag, double area) {
    const Vec3 normal = sign * a.directions[static_cast<std::size_t>(direction)].normal;
    planes::ArrangedPlane p;
    p.plane = {normal, normal.dot(center + offset)};
    p.direction = direction;
    p.frame = a.directions[static_cast<std::size_t>(direction)].frame;
    p.area = area;
    p.points = 100 + a.planes.size();
    p.rms = 0.1 / 3.0;
    p.tag = tag;
    p.polygon = {rectangle(center + offset, normal, 2, 1.5)};
    a.planes.push_back(p);
  };
  add(0, 1, Vec3::Zero(), "floor", 11);
  std::vector<Vec3> hole = rectangle(offset, Vec3::UnitZ(), 0.5, 0.5);
  a.planes[0].polygon.push_back({hole.rbegin(), hole.rend()});
  add(1, 1, {2, 0, 1}, "wall", 12);
  add(2, -1, {0, 2, 1}, "wall", 12);
  add(0, -1, {0, 0, 2.5}, "", 12);
  add(3, 1, {0.3, 0.1, 1}, "", 12);
  a.relations = {{0, 1, kPi / 2}, {0, 2, kPi / 2}, {1, 2, kPi / 2}, {0, 3, radians(60.0)}};
  a.plane_relations = 9;
  a.coplanar = {{1, 2}};
  a.spacing = {{{0, 3}, 2.5, 0.001}};
  a.distances = {{0, 3, 2.5}};
  a.equal_lengths = {{{0, 1, 2}, 4.0, 0.0}};
  a.summary.seconds = {{"assign", 0.25}, {"read", 1.0 / 3.0}};
  a.summary.energy = {{"after", 1.5}, {"before", 17.25}};
  a.summary.counts = {{"assigned", 510}, {"patches", 7}, {"planes", 5}, {"points", 600}};
  a.summary.warnings = {"normals unusable: <re-estimated> \"quoted\""};
  return a;
}

/// Two lines of a drawing.
inline planes::Arrangement sample_drawing() {
  planes::Arrangement a;
  a.two_dimensional = true;
  a.scale = 0.01;
  a.angles = {kPi / 2};
  a.directions = {{Vec3::UnitX(), 0}, {Vec3::UnitY(), 0}};
  a.frames = {{{0, 1}, {0, 1}}};
  for (int i = 0; i < 2; ++i) {
    planes::ArrangedPlane p;
    p.plane = {a.directions[static_cast<std::size_t>(i)].normal, 0.5};
    p.direction = i;
    p.frame = 0;
    p.area = 2;
    p.points = 10;
    p.segment = i == 0 ? std::array<Vec3, 2>{Vec3(0.5, -1, 0), Vec3(0.5, 1, 0)}
                       : std::array<Vec3, 2>{Vec3(-1, 0.5, 0), Vec3(1, 0.5, 0)};
    a.planes.push_back(p);
  }
  a.relations = {{0, 1, kPi / 2}};
  a.plane_relations = 1;
  a.summary.counts = {{"points", 20}, {"assigned", 20}};
  return a;
}

}  // namespace unseen::report
