// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/cuboid_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace unseen::report {
namespace {

constexpr double kTolerance = 0.003;  ///< m: an extension below this is the noise of a fit

/// A part of a box given by its corners along the box's own axes.
OrientedBox part_of(const OrientedBox& box, const Vec3& low, const Vec3& high) {
  return {box.center + box.axes * (0.5 * (low + high)), box.axes, 0.5 * (high - low)};
}

/// Root of a node in a forest.
std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

SeenPart seen_part(const cuboids::Cuboid& c) {
  if (c.by_symmetry) return {};
  const Mat3 turn = c.box.axes.transpose() * c.initial.axes;
  const Vec3 center = c.box.axes.transpose() * (c.initial.center - c.box.center);
  const Vec3 reach = turn.cwiseAbs() * c.initial.half_size;
  SeenPart part = {center - reach, center + reach};
  for (int a = 0; a < 3; ++a) {
    const double half = c.box.half_size[a];
    part.low[a] = std::clamp(part.low[a], -half, half);
    part.high[a] = std::clamp(part.high[a], -half, half);
    if (part.low[a] + half < kTolerance) part.low[a] = -half;
    if (half - part.high[a] < kTolerance) part.high[a] = half;
  }
  return part.is_empty() ? SeenPart{} : part;
}

OrientedBox seen_box(const cuboids::Cuboid& c) {
  const SeenPart seen = seen_part(c);
  return part_of(c.box, seen.low, seen.high);
}

std::vector<OrientedBox> hidden_boxes(const cuboids::Cuboid& c) {
  const SeenPart seen = seen_part(c);
  if (seen.is_empty()) return {c.box};
  std::vector<OrientedBox> parts;
  Vec3 low = -c.box.half_size, high = c.box.half_size;  // what is left; axis by axis it shrinks to the seen part
  for (int a = 0; a < 3; ++a) {
    if (seen.low[a] > low[a]) {
      Vec3 end = high;
      end[a] = seen.low[a];
      parts.push_back(part_of(c.box, low, end));
    }
    if (seen.high[a] < high[a]) {
      Vec3 start = low;
      start[a] = seen.high[a];
      parts.push_back(part_of(c.box, start, high));
    }
    low[a] = seen.low[a];
    high[a] = seen.high[a];
  }
  return parts;
}

std::string name_of(const cuboids::Cuboid& c) {
  return c.label.empty() ? fmt::format("box {}", c.id) : fmt::format("box {} ({})", c.id, c.label);
}

std::string name_of(const cuboids::Support& s) {
  return fmt::format("{} {}", cuboids::kSupportKinds[static_cast<int>(s.kind)], s.id);
}

std::string attribute_of(const Vec3& v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x(), v.y(), v.z()); }

std::vector<Vec3> corners_of(const OrientedBox& box) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(box.center + box.axes * Vec3((k & 1 ? 1 : -1) * box.half_size.x(),
                                                   (k & 2 ? 1 : -1) * box.half_size.y(),
                                                   (k & 4 ? 1 : -1) * box.half_size.z()));
  return corners;
}

std::vector<Vec3> polygon_of(const cuboids::Support& s, const cuboids::Completion& c) {
  if (!s.outline.empty()) return s.outline;
  const bool upright = std::abs(s.plane.normal.z()) < 0.7;
  Vec3 u = upright             ? Vec3(s.plane.normal.cross(Vec3::UnitZ()))
           : c.cuboids.empty() ? Vec3(Vec3::UnitX())
                               : c.cuboids.front().box.axes.col(0);
  u -= u.dot(s.plane.normal) * s.plane.normal;
  u = u.norm() > 1e-3 ? u.normalized() : any_orthogonal(s.plane.normal);
  const Vec3 v = s.plane.normal.cross(u), origin = s.plane.project(Vec3::Zero());
  Eigen::AlignedBox2d reach;
  for (const cuboids::Cuboid& cuboid : c.cuboids)
    for (const Vec3& corner : corners_of(cuboid.box))
      reach.extend(Vec2(u.dot(corner - origin), v.dot(corner - origin)));
  if (reach.isEmpty()) reach.extend(Vec2::Zero());
  const double margin = 0.1 + 0.2 * reach.sizes().maxCoeff();  // m, so that what stands at the edge still stands on it
  const Vec2 low = reach.min().array() - margin, high = reach.max().array() + margin;
  return {origin + low.x() * u + low.y() * v, origin + high.x() * u + low.y() * v, origin + high.x() * u + high.y() * v,
          origin + low.x() * u + high.y() * v};
}

std::vector<RigidGroup> rigid_groups(const cuboids::Completion& c) {
  std::map<int, std::size_t> index;
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) index[c.cuboids[i].id] = i;
  std::vector<std::size_t> parent(c.cuboids.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const cuboids::Contact& contact : c.contacts) {
    const auto a = index.find(contact.a), b = index.find(contact.b);
    if (contact.kind != cuboids::ContactKind::fixed || a == index.end() || b == index.end()) continue;
    const std::size_t low = root(parent, a->second), high = root(parent, b->second);
    parent[std::max(low, high)] = std::min(low, high);
  }
  std::vector<RigidGroup> groups;
  std::vector<std::size_t> group_of(c.cuboids.size());
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
    const std::size_t first = root(parent, i);
    if (first == i) {
      group_of[i] = groups.size();
      groups.emplace_back();
    }
    group_of[i] = group_of[first];
    groups[group_of[i]].cuboids.push_back(i);
  }
  for (const cuboids::Contact& contact : c.contacts) {
    const auto b = index.find(contact.b);
    if (contact.kind != cuboids::ContactKind::fixed || index.count(contact.a) != 0 || b == index.end()) continue;
    RigidGroup& group = groups[group_of[b->second]];
    if (group.support < 0) group.support = contact.a;
  }
  return groups;
}

DepthPoints depth_points(const RgbdFrame& frame, const RigidTransform& T_world_camera, std::size_t limit) {
  DepthPoints points;
  const auto add = [&](const Vec3& p, const auto& colors, std::size_t i) {
    points.positions.push_back(T_world_camera * p);
    if (!colors.empty()) points.colors.push_back(colors[i]);
  };
  if (frame.is_fused()) {
    const auto& all = frame.cloud.positions;
    const std::size_t step = std::max<std::size_t>(1, (all.size() + limit - 1) / limit);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].allFinite()) continue;
      if (points.seen++ % step == 0) add(frame.cloud_point(i), frame.cloud.colors, i);
    }
    return points;
  }
  const std::size_t width = static_cast<std::size_t>(frame.camera.width);
  const std::size_t step = static_cast<std::size_t>(
      std::ceil(std::sqrt(std::max(1.0, static_cast<double>(frame.depth.size()) / static_cast<double>(limit)))));
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (!(frame.depth[i] > 0.0f)) continue;
    ++points.seen;
    const std::size_t u = i % width, v = i / width;
    if (u % step == 0 && v % step == 0)
      add(frame.camera.unproject(static_cast<double>(u), static_cast<double>(v), frame.depth[i]), frame.color, i);
  }
  return points;
}

std::vector<int> cuboid_of_point(const std::vector<Vec3>& points, const std::vector<cuboids::Cuboid>& cuboids) {
  constexpr double kReach = 0.01;  // m
  std::vector<int> owner(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = kReach;
    for (std::size_t k = 0; k < cuboids.size(); ++k) {
      const OrientedBox& box = cuboids[k].box;
      const double outside = ((box.axes.transpose() * (points[i] - box.center)).cwiseAbs() - box.half_size).maxCoeff();
      if (outside >= nearest) continue;
      nearest = outside;
      owner[i] = static_cast<int>(k);
    }
  }
  return owner;
}

}  // namespace unseen::report
