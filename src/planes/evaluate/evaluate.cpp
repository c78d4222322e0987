// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planes/evaluate/triangle_tree.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr double kSameNormal = 1e-4;  // rad

/// What is true at one point.
struct Truth {
  enum class Normal : std::uint8_t { known, ambiguous, uncovered };
  Vec3 normal = Vec3::Zero();
  Vec3 projection = Vec3::Zero();
  Normal state = Normal::uncovered;
};

void check(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
           const std::vector<Plane>& planes) {
  if (plane_of_point.size() != points.size())
    throw InputError("evaluate", "plane_of_point", fmt::format("{} entries", plane_of_point.size()),
                     fmt::format("one a point: {}", points.size()));
  for (const int plane : plane_of_point)
    if (plane >= static_cast<int>(planes.size()))
      throw InputError("evaluate", "plane_of_point", fmt::format("plane {}", plane),
                       fmt::format("-1 or one of {} planes", planes.size()));
}

void check(const EvaluateOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale))
    throw InputError("evaluate", "scale", fmt::format("{}", options.scale), "a length above 0");
}

AngleScore score_pairs(const std::vector<std::size_t>& used, const std::vector<int>& plane_of_point,
                       const std::vector<Plane>& planes, const std::vector<Truth>& truth,
                       const EvaluateOptions& options, Context& context) {
  AngleScore score;
  if (used.size() < 2 || options.pairs == 0) return score;
  Random random(options.seed);
  std::vector<double> errors;
  errors.reserve(options.pairs);
  while (errors.size() < options.pairs) {
    if (errors.size() % kGrain == 0) context.check();
    const std::size_t a = used[random.index(used.size())], b = used[random.index(used.size())];
    if (a == b) continue;
    const double assigned = line_angle(planes[plane_of_point[a]].normal, planes[plane_of_point[b]].normal);
    errors.push_back(std::abs(assigned - line_angle(truth[a].normal, truth[b].normal)));
  }
  const double count = static_cast<double>(errors.size());
  const auto share_below = [&](double bound) {
    return static_cast<double>(
               std::count_if(errors.begin(), errors.end(), [bound](double e) { return e < bound; })) /
           count;
  };
  score.pairs = errors.size();
  score.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  double squares = 0;
  for (const double e : errors) squares += (e - score.mean) * (e - score.mean);
  score.deviation = std::sqrt(squares / count);
  score.below_tenth = share_below(radians(0.1));
  score.below_one = share_below(radians(1.0));
  score.median = median(std::move(errors));
  return score;
}

AssignmentScore score_assignment(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                 const std::vector<Plane>& planes, const std::vector<Truth>& truth,
                                 const EvaluateOptions& options, Context& context) {
  AssignmentScore score;
  std::vector<std::size_t> used, recalled;
  std::size_t known = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (truth[i].state != Truth::Normal::known) continue;
    ++known;
    if (plane_of_point[i] < 0) continue;
    used.push_back(i);
    const Vec3 projection = planes[plane_of_point[i]].project(points[i]);
    if ((projection - truth[i].projection).norm() <= options.scale) recalled.push_back(i);
  }
  score.used = used.size();
  score.recalled = recalled.size();
  if (known > 0) score.recall = static_cast<double>(recalled.size()) / static_cast<double>(known);
  score.angles = score_pairs(used, plane_of_point, planes, truth, options, context);
  score.angles_recalled = score_pairs(recalled, plane_of_point, planes, truth, options, context);
  return score;
}

TruthScore score_both_ways(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                           const std::vector<Plane>& planes, const std::vector<Truth>& truth,
                           const EvaluateOptions& options, Context& context) {
  TruthScore score;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    ++score.points;
    if (plane_of_point[i] >= 0) ++score.assigned;
    if (truth[i].state == Truth::Normal::ambiguous) ++score.ambiguous;
    if (truth[i].state == Truth::Normal::uncovered) ++score.uncovered;
  }
  score.as_assigned = score_assignment(points, plane_of_point, planes, truth, options, context);
  score.nearest = score_assignment(points, assign_to_nearest(points, plane_of_point, planes, context), planes,
                                   truth, options, context);
  return score;
}

}  // namespace

std::vector<int> assign_to_nearest(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                   const std::vector<Plane>& planes, Context& context) {
  check(points, plane_of_point, planes);
  std::vector<int> nearest = plane_of_point;
  parallel_blocks(context, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (plane_of_point[i] >= 0 || !points[i].allFinite()) continue;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < planes.size(); ++k) {
        const double distance = std::abs(planes[k].signed_distance(points[i]));
        if (distance >= best) continue;
        best = distance;
        nearest[i] = static_cast<int>(k);
      }
    }
  });
  return nearest;
}

MeshScore evaluate_against_mesh(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                const std::vector<Plane>& planes, const TriangleMesh& mesh,
                                const EvaluateOptions& options, Context& context) {
  check(options);
  check(points, plane_of_point, planes);
  const TriangleTree tree(mesh);
  if (tree.empty())
    throw InputError("evaluate", "truth",
                     fmt::format("{} triangles, none with an area", mesh.triangles.size()),
                     "a mesh with at least one");
  std::vector<Truth> truth(points.size());
  parallel_blocks(context, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!points[i].allFinite()) continue;
      const TriangleTree::Hit hit = tree.nearest(points[i]);
      truth[i] = {hit.normal, hit.point, Truth::Normal::known};
      if (hit.distance > options.scale)
        truth[i].state = Truth::Normal::uncovered;
      else if (tree.normals_differ(points[i], options.scale, kSameNormal))
        truth[i].state = Truth::Normal::ambiguous;
    }
  });
  return score_both_ways(points, plane_of_point, planes, truth, options, context);
}

ResultScore evaluate_against_result(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                    const std::vector<Plane>& planes,
                                    const std::vector<int>& true_plane_of_point,
                                    const std::vector<Plane>& true_planes, const EvaluateOptions& options,
                                    Context& context) {
  check(options);
  check(points, plane_of_point, planes);
  check(points, true_plane_of_point, true_planes);
  std::vector<Truth> truth(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (true_plane_of_point[i] < 0 || !points[i].allFinite()) continue;
    const Plane& plane = true_planes[true_plane_of_point[i]];
    truth[i] = {plane.normal, plane.project(points[i]), Truth::Normal::known};
  }
  return score_both_ways(points, plane_of_point, planes, truth, options, context);
}

}  // namespace unseen::planes
