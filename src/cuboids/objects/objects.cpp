// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numeric>

#include "core/linear.h"
#include "cuboids/objects/join_surfaces.h"
#include "cuboids/objects/plain_colors.h"
#include "cuboids/objects/seams.h"
#include "cuboids/objects/stack_levels.h"
#include "cuboids/objects/strokes.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/depth_view.h"
#include "cuboids/surfaces/observation.h"
#include "cuboids/surfaces/supports.h"
#include "unseen/core/convex.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kFewestObjectPoints = 80;     // of an object
constexpr double kSmallestObject = 0.003;        // of the points of all objects, where nobody says what an object is
constexpr std::size_t kFewPoints = 500;         // so few may be a strip along an edge
constexpr double kStrip = 8.0;                 // widths, in spacing
constexpr double kLowest = 4.0;               // σ above the supports; below, it is speckle of theirs
constexpr std::size_t kMostNamed = 10;         // masks, in a warning
constexpr std::size_t kRoughStep = 4;          // every so many points tell how rough a support is,
constexpr double kRoughest = 0.05;             // m; if they are no farther from it,
constexpr double kLeastSlant = 0.3;            // cosine: that a ray meets it at, at the least,
constexpr double kBelow = 0.16, kBelowNormal = 0.994, kMedian = 0.6745;  // of a normal distribution: that is below so many standard deviations; of half the absolute values
constexpr double kMostRough = 0.01;            // m: what is rougher is no surface
constexpr double kOutside = 0.02;             // m beyond the outline of the ground, where something else carries

/// Points of equal non-negative group that links connect.
std::vector<std::vector<int>> components(const Observation& seen, const std::vector<int>& group) {
  std::vector<std::vector<int>> parts;
  std::vector<char> done(group.size(), 0);
  for (int s = 0; s < static_cast<int>(group.size()); ++s) {
    if (group[s] < 0 || done[s]) continue;
    std::vector<int> part{s};
    done[s] = 1;
    for (std::size_t at = 0; at < part.size(); ++at)
      for (const int j : seen.graph.neighbours(part[at]))
        if (!done[j] && group[j] == group[s]) done[j] = 1, part.push_back(j);
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Which points may belong to objects: not of a support, not below the ground. What lies beyond the ground's end is carried by something else,
/// or hangs over, with most of it above the ground.
std::vector<int> candidates(const Observation& seen) {
  std::vector<int> group(seen.points.size(), -1);
  const std::vector<Vec2> outline = plan_of(seen.supports.front());
  std::vector<char> beyond(seen.points.size(), 0);
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const Vec3& p = seen.points[i];
    if (seen.support_of_point[i] >= 0 || seen.supports.front().plane.signed_distance(p) < 0.0) continue;
    beyond[i] = !outline.empty() && !inside_convex(outline, p.head<2>(), kOutside);
    const bool behind = std::any_of(seen.supports.begin() + 1, seen.supports.end(), [&](const Support& s) {
      return s.kind == SupportKind::wall && s.plane.signed_distance(p) < -4.0 * seen.graph.sigma[i] && s.plane.signed_distance(p) > -0.1;
    });
    if (!behind) group[i] = 0;
  }
  if (outline.empty()) return group;
  for (const std::vector<int>& part : components(seen, group)) {
    const auto out = std::count_if(part.begin(), part.end(), [&](int i) { return beyond[i] != 0; });
    if (2 * static_cast<std::size_t>(out) < part.size()) continue;
    for (const int i : part)
      if (beyond[i] != 0) group[i] = -1;
  }
  return group;
}

/// m: how rough the ground and desks are beyond the noise of the depth, as grass or a carpet. What lies below their planes tells: nothing stands there.
std::vector<double> roughness_of(const Observation& seen) {
  std::vector<double> roughness;
  for (const Support& support : seen.supports) {
    const std::vector<Vec2> outline = plan_of(support);
    std::vector<std::pair<double, double>> measured;  // the noise of the height, and the height
    for (std::size_t i = 0; i < seen.points.size() && support.kind <= SupportKind::desk; i += kRoughStep) {
      const double height = support.plane.signed_distance(seen.points[i]);
      if (std::abs(height) > kRoughest || (!outline.empty() && !inside_convex(outline, seen.points[i].head<2>(), 0.0))) continue;
      const double slant = std::abs(support.plane.normal.dot((seen.points[i] - seen.T_world_camera.translation).normalized()));
      measured.emplace_back(seen.graph.sigma[i] * std::max(slant, kLeastSlant), height);
    }
    std::sort(measured.begin(), measured.end());
    measured.resize((measured.size() + 1) / 2);  // where it is measured best
    std::vector<double> heights, off;
    double variance = 0;
    for (const auto& [noise, height] : measured) {
      heights.push_back(height);
      off.push_back(std::abs(height));
      variance += noise * noise / static_cast<double>(measured.size());
    }
    const double scatter = std::min(std::max(-quantile(std::move(heights), kBelow), 0.0) / kBelowNormal, median(std::move(off)) / kMedian);
    const double rough = std::sqrt(std::max(scatter * scatter - variance, 0.0));
    roughness.push_back(rough > kMostRough ? 0.0 : rough);
  }
  return roughness;
}

/// How many points an object has at the least, among these pieces.
std::size_t fewest_object_points(const std::vector<std::vector<int>>& pieces, bool of_all) {
  const std::size_t total = std::accumulate(pieces.begin(), pieces.end(), std::size_t{0}, [](std::size_t n, const auto& p) { return n + p.size(); });
  return std::max(kFewestObjectPoints, of_all ? static_cast<std::size_t>(kSmallestObject * static_cast<double>(total)) : 0);
}

/// Too few points, or no farther from the supports than their own noise, or than these are rough.
bool is_debris(const Observation& seen, const std::vector<double>& roughness, const std::vector<int>& part, std::size_t fewest) {
  if (part.size() < fewest) return true;
  if (part.size() < kFewPoints) {
    Vec3 mean = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const int i : part) mean += seen.points[i] / static_cast<double>(part.size());
    for (const int i : part) second += (seen.points[i] - mean) * (seen.points[i] - mean).transpose() / static_cast<double>(part.size());
    const double width = std::sqrt(12.0 * std::max(symmetric_eigen(second).values[1], 0.0));
    if (width < kStrip * seen.graph.spacing[part.front()]) return true;
  }
  for (std::size_t s = 0; s < seen.supports.size(); ++s) {
    const Support& support = seen.supports[s];
    const std::vector<Vec2> outline = plan_of(support);
    std::vector<double> height;
    for (const int i : part) {
      const bool beside = !outline.empty() && support.kind <= SupportKind::desk && !inside_convex(outline, seen.points[i].head<2>(), kOutside);
      height.push_back(beside ? kLowest : std::abs(support.plane.signed_distance(seen.points[i])) / std::hypot(seen.graph.sigma[i], roughness[s]));
    }
    if (quantile(std::move(height), 0.9) < kLowest) return true;
  }
  return false;
}

/// Says which masks came to nothing. Those that lie on a support for the most part are of that.
void warn_of_lost_masks(const RgbdFrame& frame, const Observation& seen, const std::vector<ObjectPart>& parts, Context& context) {
  std::map<int, int> balance;  // of each mask: points on no support, less those on one
  for (const int mask : frame.masks)
    if (mask > 0) balance.emplace(mask, 0);
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    if (const int mask = frame.masks[seen.pixel_of_point[i]]; mask > 0) balance[mask] += seen.support_of_point[i] < 0 ? 1 : -1;
  for (const ObjectPart& part : parts) balance.erase(std::stoi(part.label));
  std::erase_if(balance, [](const auto& mask) { return mask.second < 0; });
  if (balance.empty()) return;
  std::vector<int> named;
  for (const auto& [mask, count] : balance)
    if (named.size() < kMostNamed) named.push_back(mask);
  context.warn(fmt::format("{} of the masks became no object, too little of them was measured: {}{}", balance.size(), fmt::join(named, ", "),
                           balance.size() > named.size() ? ", …" : ""));
}

}  // namespace

std::vector<ObjectPart> find_objects(const RgbdFrame& frame, const Observation& seen, const Options& options, Context& context) {
  std::vector<int> group = candidates(seen);
  std::vector<std::string> labels;
  const bool drawn = !frame.strokes.empty() && !frame.is_fused(), masked = !frame.masks.empty() && !frame.is_fused();
  if (drawn) {
    labels = stroke_labels(frame);
    const std::vector<int> label = options.strokes == "surface" ? spread_strokes(frame, seen, join_surfaces(seen, group, no_stacks(seen).piece_of_point))
                                                                : cut_by_strokes(frame, seen);
    for (std::size_t i = 0; i < group.size(); ++i)
      group[i] = group[i] < 0 ? -1 : label[i] + 1;  // 0 = the rest
    for (std::size_t l = 0; l < labels.size(); ++l)
      if (std::find(group.begin(), group.end(), static_cast<int>(l) + 1) == group.end()) context.warn(fmt::format("strokes of \"{}\" touch no object", labels[l]));
  } else if (masked) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int mask = frame.masks[seen.pixel_of_point[i]];
      group[i] = mask > 0 && seen.support_of_point[i] < 0 ? mask : -1;
    }
  }
  context.check();
  std::vector<int> object = group;
  Stacks stacks = no_stacks(seen);
  if (!masked) {
    std::vector<int> joined = join_surfaces(seen, group, stacks.piece_of_point);
    if (!frame.is_fused()) {
      const std::vector<std::vector<int>> parts = components(seen, joined);
      stacks = find_stacks(seen, parts, context);
      find_plain_colors(frame, seen, parts, DepthView(frame, seen.T_world_camera, depth_noise(frame, options)), stacks, context);
      find_seams(frame, seen, parts, fewest_object_points(parts, !drawn), stacks, context);
    }
    if (stacks.stack_of_piece.size() > 1) joined = join_surfaces(seen, group, stacks.piece_of_point);
    const int first = static_cast<int>(labels.size()) + 2;
    for (std::size_t i = 0; i < object.size(); ++i)
      if (group[i] == 0 && joined[i] >= 0) object[i] = first + joined[i];
  }
  context.check();
  std::vector<ObjectPart> parts;
  const std::vector<double> roughness = roughness_of(seen);
  std::size_t debris = 0;
  std::vector<std::vector<int>> pieces = components(seen, object);
  const std::size_t fewest = fewest_object_points(pieces, !masked && !drawn);
  for (std::vector<int>& points : pieces) {
    if (is_debris(seen, roughness, points, fewest)) {
      ++debris;
      continue;
    }
    ObjectPart part;
    const int g = group[points.front()];
    if (masked) part.label = std::to_string(g);
    if (drawn && g > 0) {
      part.label = labels[g - 1];
      part.free_orientation = true;
    }
    for (const int i : points) part.level = std::max(part.level, stacks.piece_of_point[i]);
    part.stack = stacks.stack_of_piece[part.level];
    part.points = std::move(points);
    parts.push_back(std::move(part));
  }
  if (masked) warn_of_lost_masks(frame, seen, parts, context);
  if (debris > 0) context.message(fmt::format("{} pieces too small to be objects were left out", debris));
  return parts;
}

}  // namespace unseen::cuboids
