// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cuboids/boxes/box_axes.h"
#include "cuboids/boxes/box_fit.h"
#include "cuboids/objects/slabs.h"
#include "cuboids/objects/tints.h"
#include "cuboids/search/reach.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kFewestPointsOfSide = 24;
constexpr double kVoxelSigmas = 3.0;
constexpr double kFinestVoxel = 0.005;  // of the radius of the objects
constexpr double kFarthest = 100.0;     // m
constexpr double kOnSurfaceSigmas = 3.0, kOnSurface = 0.8;  // of the points of a remnant
constexpr double kRemnant = 0.25;                            // of the points of what it is a remnant of, at most
constexpr double kUnbroken = 2.0;                            // spacing and σ, between points that carry a box down
constexpr double kSlender = 16.0, kSlenderLength = 2.0;      // σ, of a post's width at most, and widths, of its length at least

/// Bounding radius of the objects, supports left out.
double radius_of(const Observation& seen, const std::vector<ObjectPart>& parts) {
  Vec3 low = Vec3::Constant(1e30), high = -low;
  for (const ObjectPart& part : parts)
    for (const int i : part.points) low = low.cwiseMin(seen.points[i]), high = high.cwiseMax(seen.points[i]);
  return 0.5 * (high - low).norm();
}

double bottom_of(const OrientedBox& box) { return box.center.z() - box.half_size.z(); }

/// How far (m) above the ground the points of what stands on it may end: the lowest slice counts as ground's.
double height_of_end(const Observation& seen, std::span<const int> points) {
  return 5.0 * mean_sigma(seen, points) + 2.0 * seen.graph.spacing[points.front()];
}

bool is_upright(const OrientedBox& box) { return box.axes(2, 2) >= 1.0 - 1e-9; }

/// An upright box whose bottom alone is lower, by so much (m).
OrientedBox lowered(OrientedBox box, double by) {
  box.center.z() -= 0.5 * by;
  box.half_size.z() += 0.5 * by;
  return box;
}

/// What ends no higher than that above the ground (m), on it.
OrientedBox set_down(const OrientedBox& box, double height) {
  const double bottom = bottom_of(box);
  return is_upright(box) && std::abs(bottom) <= height ? lowered(box, bottom) : box;
}

/// Whether noise leaves open how an upright box is turned.
bool is_post(const OrientedBox& box, double sigma) {
  const double half_width = box.half_size.head<2>().maxCoeff();
  return 2.0 * half_width < kSlender * sigma && box.half_size.z() > kSlenderLength * half_width;
}

/// Of each part that is a post, the largest other one in whose plan it lies, as a leg below a top; −1 = none.
std::vector<int> tops_of_posts(const Observation& seen, const std::vector<ObjectPart>& parts, const std::vector<OrientedBox>& boxes) {
  std::vector<char> post;
  for (std::size_t k = 0; k < parts.size(); ++k) post.push_back(is_post(boxes[k], mean_sigma(seen, parts[k].points)));
  std::vector<int> tops(parts.size(), -1);
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (!post[k] || post[j] || parts[k].free_orientation || (tops[k] >= 0 && boxes[j].volume() <= boxes[tops[k]].volume())) continue;
      const Vec3 off = (boxes[j].axes.transpose() * (boxes[k].center - boxes[j].center)).cwiseAbs() - boxes[j].half_size;
      if (std::max(off.x(), off.y()) < boxes[k].half_size.head<2>().maxCoeff()) tops[k] = static_cast<int>(j);
    }
  return tops;
}

/// Of each part, whether it is but a remnant of another one that is none, and whose box is known better: a strip of a top that something stands on.
std::vector<char> find_remnants(const Observation& seen, const std::vector<ObjectPart>& parts, const std::vector<OrientedBox>& boxes, const std::vector<char>& full) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return parts[a].points.size() > parts[b].points.size(); });
  std::vector<char> remnant(parts.size(), 0);
  for (const std::size_t k : order)
    remnant[k] = parts[k].label.empty() && std::any_of(order.begin(), order.end(), [&](std::size_t other) {
      return full[other] && !remnant[other] && parts[other].label.empty() && static_cast<double>(parts[k].points.size()) < kRemnant * static_cast<double>(parts[other].points.size()) &&
             share_on_surface(seen, parts[k].points, boxes[other], kOnSurfaceSigmas) > kOnSurface;
    });
  return remnant;
}

/// An upright box carried down to where the points right below it end that are of no box, where these fill what is added.
OrientedBox carried_down(const Observation& seen, const DepthView& view, std::span<const int> boxless, const OrientedBox& box, double fill) {
  if (!is_upright(box)) return box;
  std::vector<double> height;
  double gap = 0;
  for (const int i : boxless) {
    const Vec3 local = box.axes.transpose() * (seen.points[i] - box.center);
    if ((local.head<2>().cwiseAbs() - box.half_size.head<2>()).maxCoeff() > kNearSurface * seen.graph.sigma[i] || seen.points[i].z() > bottom_of(box)) continue;
    height.push_back(seen.points[i].z());
    gap = std::max(gap, kUnbroken * (static_cast<double>(seen.graph.spacing[i]) + seen.graph.sigma[i]));
  }
  if (height.size() < kFewestPointsOfSide) return box;
  std::sort(height.rbegin(), height.rend());
  double end = bottom_of(box);
  for (const double z : height)
    if (end - z < gap) end = z;
  const double down = bottom_of(box) - end;
  OrientedBox below = box;
  below.half_size.z() = 0.5 * down;
  below.center.z() = end + 0.5 * down;
  return down > 0.0 && filled_share(view, below, 0.25 * down) >= fill ? lowered(box, down) : box;
}

/// Whether a box ends nearer to what lies below it than to the ground.
bool stands_on_another(const std::vector<Cuboid>& cuboids, const OrientedBox& box) {
  return std::any_of(cuboids.begin(), cuboids.end(), [&](const Cuboid& other) {
    if (bottom_of(other.initial) > bottom_of(box) || other.initial.center.z() > bottom_of(box)) return false;
    const auto gap = reach(box, 4, solid_of(other.initial), 0.0);
    return gap && *gap < bottom_of(box);
  });
}

}  // namespace

std::vector<Cuboid> fit_cuboids(const RgbdFrame& frame, const Observation& seen, const std::vector<ObjectPart>& parts,
                                const DepthView& view, const Options& options, Context& context) {
  std::vector<Cuboid> cuboids;
  if (parts.empty()) return cuboids;
  std::vector<int> group(seen.points.size(), -1);
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const int i : parts[k].points) group[i] = static_cast<int>(k);
  const Faces faces = grow_faces(seen.points, seen.graph, group, seen.T_world_camera.translation, kFewestPointsOfSide);
  std::vector<std::vector<const Face*>> faces_of(parts.size());
  for (const Face& face : faces.faces) faces_of[group[face.points.front()]].push_back(&face);

  const double finest = kFinestVoxel * radius_of(seen, parts);
  std::vector<double> end_heights;
  for (const auto& [label, density] : frame.densities)
    if (std::none_of(parts.begin(), parts.end(), [&](const ObjectPart& part) { return part.label == label; }))
      context.warn(fmt::format("densities: \"{}\" is the label of no object in the picture: its density is not used", label));
  const auto object_of = [&](const ObjectPart& part) {
    const auto first = std::find_if(parts.begin(), parts.end(), [&](const ObjectPart& other) {
      return &other == &part || (!part.label.empty() && other.label == part.label);
    });
    return static_cast<int>(first - parts.begin());
  };
  const auto add = [&](const ObjectPart& part, std::span<const int> points, const OrientedBox& box) {
    if (box.half_size.maxCoeff() > kFarthest)
      throw InputError(frame.name, "depth", "a box of over 100 m", "metres after division by depth_scale");
    Cuboid cuboid;
    cuboid.id = static_cast<int>(seen.supports.size() + cuboids.size());
    cuboid.initial = box;
    cuboid.visible_points = points.size();
    cuboid.label = part.label;
    cuboid.stack = part.stack;
    cuboid.level = part.level;
    cuboid.tint = plain_tint(seen, points);
    cuboid.object = object_of(part);
    const auto density = frame.densities.find(part.label);
    cuboid.density = density == frame.densities.end() ? options.density : density->second;
    cuboids.push_back(cuboid);
    end_heights.push_back(height_of_end(seen, points));
  };
  std::vector<OrientedBox> boxes;
  std::map<std::string, std::vector<int>> boxless;  // by label: points of parts too hollow for any
  const auto voxel_of = [&](const ObjectPart& part) { return std::max(kVoxelSigmas * mean_sigma(seen, part.points), finest); };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    context.check();
    const ObjectPart& part = parts[k];
    boxes.push_back(bound(seen, view, part.points, faces_of[k], box_axes(seen, view, part.points, faces_of[k], part.free_orientation), voxel_of(part)));
  }
  const std::vector<int> top = tops_of_posts(seen, parts, boxes);
  std::vector<char> full;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double voxel = voxel_of(parts[k]);
    if (top[k] >= 0) boxes[k] = bound_along(seen, view, parts[k].points, faces_of[k], boxes[k].axes, boxes[top[k]].axes, voxel);
    full.push_back(filled_share(view, set_down(boxes[k], height_of_end(seen, parts[k].points)), voxel) >= options.fill);
  }
  const std::vector<char> remnant = find_remnants(seen, parts, boxes, full);
  if (const auto count = std::count(remnant.begin(), remnant.end(), 1); count > 0)
    context.message(fmt::format("{} strips on the surface of a larger box count as part of it", count));
  for (std::size_t k = 0; k < parts.size(); ++k) {
    context.check();
    const ObjectPart& part = parts[k];
    if (remnant[k]) continue;
    if (full[k]) {
      add(part, part.points, boxes[k]);
      continue;
    }
    const double voxel = voxel_of(part);
    const std::vector<std::vector<int>> slabs = split_into_slabs(seen, view, part.points, set_down(boxes[k], height_of_end(seen, part.points)), voxel, options.fill);
    for (const std::vector<int>& slab : slabs) add(part, slab, bound(seen, view, slab, {}, boxes[k].axes, voxel));
    if (slabs.empty()) boxless[part.label].insert(boxless[part.label].end(), part.points.begin(), part.points.end());
  }
  for (Cuboid& cuboid : cuboids) cuboid.initial = carried_down(seen, view, boxless[cuboid.label], cuboid.initial, options.fill);
  for (std::size_t i = 0; i < cuboids.size(); ++i)
    if (!stands_on_another(cuboids, cuboids[i].initial)) cuboids[i].initial = set_down(cuboids[i].initial, end_heights[i]);
  for (Cuboid& cuboid : cuboids) cuboid.box = cuboid.initial;
  return cuboids;
}

}  // namespace unseen::cuboids
