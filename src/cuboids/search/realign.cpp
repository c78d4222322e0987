// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cuboids/boxes/box_axes.h"
#include "cuboids/boxes/box_fit.h"
#include "cuboids/search/complete.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/supports.h"
#include "unseen/core/convex.h"

namespace unseen::cuboids {
namespace {

const double kLooksThatWay = std::cos(radians(40.0)), kLargestTurn = std::cos(radians(20.0));
constexpr std::array<double, 3> kReach = {0.3, 0.15, 0.08};  // of half a box's diagonal: how far its points may lie from it, round by round
constexpr double kSideShare = 0.08, kSideSigmas = 3.0;       // of a size, and of the depth: by how much a given side may be wrong
constexpr double kExplainsMore = 0.9;                        // what a box leaves unexplained, for it to replace the one that was given
constexpr std::size_t kFewestPoints = 60;
constexpr int kFewestPointsOfSide = 24;

/// The points of a frame in the world of a scene, without those on its supports.
Observation observed(const RgbdFrame& frame, const Completion& scene, const Options& options, const Context& context) {
  const Measured measured = measured_points(frame);
  Observation seen;
  seen.T_world_camera = scene.T_world_camera;
  seen.graph = link_points(frame, measured, depth_noise(frame, options), options.gap, context);
  for (const Vec3& p : measured.points) seen.points.push_back(scene.T_world_camera * p);
  for (Vec3& n : seen.graph.normals) n = scene.T_world_camera.rotation * n;
  seen.support_of_point.assign(seen.points.size(), -1);
  for (std::size_t s = 0; s < scene.supports.size(); ++s) {
    const Support& support = scene.supports[s];
    const bool desk = support.kind == SupportKind::desk;  // what is below it is not its own
    const std::vector<Vec2> outline = plan_of(support);
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
      const double above = support.plane.signed_distance(seen.points[i]), near = kSideSigmas * seen.graph.sigma[i];
      if (above >= near) continue;
      if (desk && (above < -near || (!outline.empty() && !inside_convex(outline, seen.points[i].head<2>(), near)))) continue;
      seen.support_of_point[i] = static_cast<int>(s);
    }
  }
  return seen;
}

/// m: distance of a point to the nearest face that looks as the point's surroundings do.
double distance_to_face(const OrientedBox& box, const Vec3& point, const Vec3& normal) {
  const Vec3 p = box.axes.transpose() * (point - box.center), n = box.axes.transpose() * normal;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (std::abs(n[k]) < kLooksThatWay) continue;
    Vec3 off = (p.cwiseAbs() - box.half_size).cwiseMax(0.0);
    off[k] = (n[k] > 0.0 ? p[k] : -p[k]) - box.half_size[k];
    least = std::min(least, off.norm());
  }
  return least;
}

/// Each point's box, or −1.
std::vector<int> nearest_boxes(const Observation& seen, const std::vector<Cuboid>& cuboids, double reach, const Context& context) {
  std::vector<int> box_of(seen.points.size(), -1);
  parallel_blocks(context, seen.points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (seen.support_of_point[i] >= 0 || seen.graph.normals[i].isZero()) continue;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < cuboids.size(); ++k) {
        const OrientedBox& box = cuboids[k].initial;
        const double within = reach * box.half_size.norm();
        if ((seen.points[i] - box.center).norm() > box.half_size.norm() + within) continue;
        const double d = distance_to_face(box, seen.points[i], seen.graph.normals[i]);
        if (d > within || d >= least) continue;
        least = d;
        box_of[i] = static_cast<int>(k);
      }
    }
  });
  return box_of;
}

/// The columns of `axes`, in the order and with the signs of a box's own; none if they are turned too far.
std::optional<Mat3> as_given(const Mat3& axes, const Mat3& given) {
  Mat3 out;
  for (int k = 0; k < 3; ++k) {
    int best = 0;
    for (int j = 1; j < 3; ++j)
      if (std::abs(given.col(k).dot(axes.col(j))) > std::abs(given.col(k).dot(axes.col(best)))) best = j;
    const double cosine = given.col(k).dot(axes.col(best));
    if (std::abs(cosine) < kLargestTurn) return std::nullopt;
    out.col(k) = cosine < 0.0 ? Vec3(-axes.col(best)) : Vec3(axes.col(best));
  }
  return out;
}

OrientedBox fitted(const Observation& seen, const DepthView& view, const std::vector<int>& points, const std::vector<const Face*>& faces, OrientedBox box) {
  const auto axes = as_given(box_axes(seen, view, points, faces, false), box.axes);
  if (!axes) return box;
  box.axes = *axes;
  double sigma = 0;
  for (const int i : points) sigma += seen.graph.sigma[i] / static_cast<double>(points.size());
  const OrientedBox around = bound(seen, view, points, faces, *axes, sigma);
  const Vec3 center = axes->transpose() * box.center, to = axes->transpose() * around.center;
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    const double slack = kSideShare * 2.0 * box.half_size[k] + kSideSigmas * sigma;
    const auto side = [&](double given, double ends) { return std::abs(ends - given) < slack ? ends : given; };
    low[k] = side(center[k] - box.half_size[k], to[k] - around.half_size[k]);
    high[k] = side(center[k] + box.half_size[k], to[k] + around.half_size[k]);
  }
  box.center = *axes * (0.5 * (low + high));
  box.half_size = 0.5 * (high - low);
  return box;
}

/// How badly the faces of a box explain points, 0 to 1 a point: by the share of their noise that they are off.
double unexplained(const Observation& seen, const std::vector<int>& points, const OrientedBox& box) {
  double sum = 0;
  for (const int i : points) sum += std::min(1.0, distance_to_face(box, seen.points[i], seen.graph.normals[i]) / (kSideSigmas * seen.graph.sigma[i]));
  return sum;
}

}  // namespace

void realign(const RgbdFrame& frame, const Options& options, Completion& scene, Context& context) {
  const Observation seen = observed(frame, scene, options, context);
  const DepthView view(frame, scene.T_world_camera, depth_noise(frame, options));
  for (const double reach : kReach) {
    context.check();
    const std::vector<int> box_of = nearest_boxes(seen, scene.cuboids, reach, context);
    const Faces faces = grow_faces(seen.points, seen.graph, box_of, seen.T_world_camera.translation, kFewestPointsOfSide);
    std::vector<std::vector<int>> points(scene.cuboids.size());
    std::vector<std::vector<const Face*>> sides(scene.cuboids.size());
    for (std::size_t i = 0; i < box_of.size(); ++i)
      if (box_of[i] >= 0) points[box_of[i]].push_back(static_cast<int>(i));
    for (const Face& face : faces.faces) sides[box_of[face.points.front()]].push_back(&face);
    for (std::size_t k = 0; k < scene.cuboids.size(); ++k) {
      if (points[k].size() < kFewestPoints) continue;
      OrientedBox& box = scene.cuboids[k].initial;
      const OrientedBox again = fitted(seen, view, points[k], sides[k], box);
      if (unexplained(seen, points[k], again) < kExplainsMore * unexplained(seen, points[k], box)) box = again;
    }
  }
}

}  // namespace unseen::cuboids
