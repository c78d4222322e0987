// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/scan_completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cuboids/applications/box_matching.h"
#include "cuboids/applications/model_boxes.h"
#include "cuboids/applications/registration.h"
#include "cuboids/surfaces/depth_view.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallestModel = 0.01, kLargestModel = 100.0;  // m: sizes of a model
constexpr double kSameLevel = 0.02;                   // m
constexpr std::size_t kModelPoints = 40'000, kScenePoints = 200, kRefinePoints = 2000, kFreePoints = 200;
constexpr double kNear = 0.02;     // m: points so near to a cuboid are its own
constexpr double kOnSupport = 0.01;  // m
constexpr double kLeastExplained = 0.3;
constexpr std::array<std::uint8_t, 3> kPlain = {190, 190, 190};

std::vector<Vec3> usable_points(const PointCloud& model) {
  std::vector<Vec3> out;
  for (const Vec3& p : model.positions)
    if (p.allFinite()) out.push_back(p);
  if (out.size() < 4) throw InputError("model", "points", std::to_string(out.size()), "a scan of an object");
  Vec3 low = out.front(), high = out.front();
  for (const Vec3& p : out) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).maxCoeff();
  if (size < kSmallestModel || size > kLargestModel)
    throw InputError("model", "size", fmt::format("{:.3g} m", size), fmt::format("{} to {} m: is the unit metres?", kSmallestModel, kLargestModel));
  return out;
}

double lowest(const OrientedBox& box) { return box.center.z() - box.axes.row(2).cwiseAbs().dot(box.half_size); }

OrientedBox lifted(OrientedBox box, double by) {
  box.center.z() += by;
  return box;
}

/// Heights at which cuboids stand.
std::vector<double> levels_of(const Completion& scene) {
  std::vector<double> bottoms, levels;
  for (const Cuboid& c : scene.cuboids) bottoms.push_back(lowest(c.box));
  std::sort(bottoms.begin(), bottoms.end());
  for (const double z : bottoms)
    if (levels.empty() || z - levels.back() > kSameLevel) levels.push_back(z);
  return levels;
}

/// Points in or near a box but not on a support.
std::vector<Vec3> points_of(const OrientedBox& box, const Completion& scene, const std::vector<Vec3>& points) {
  OrientedBox wide = box;
  wide.half_size.array() += kNear;
  std::vector<Vec3> out;
  for (const Vec3& p : points)
    if (wide.contains(p) && std::none_of(scene.supports.begin(), scene.supports.end(), [&](const Support& s) {
          return std::abs(s.plane.signed_distance(p)) < kOnSupport;
        }))
      out.push_back(p);
  return out;
}

/// A way to lay the model into the scene.
struct Pose {
  RigidTransform T_world_model;
  std::vector<BoxMatch> matches;  ///< indices of both
  double score = 0;               ///< points that it explains, less what contradicts it
};

struct Search {
  const SampledSurface& surface;
  const std::vector<Vec3>& model;       ///< few points of it
  const std::vector<Vec3>& scene;       ///< few points of the cuboids
  const DepthView& view;
  const ScanCompletionOptions& options;

  double score(const RigidTransform& T_world_model) const {
    const RigidTransform back = T_world_model.inverse();
    double explained = 0.0;
    for (const Vec3& p : scene)
      if (const auto partner = surface.nearest(back * p, options.reach))
        explained += 1.0 - (surface.points()[*partner] - back * p).norm() / options.reach;
    std::size_t in_free_space = 0;
    for (const Vec3& p : model) {
      const Vec3 toward = (view.viewpoint() - T_world_model * p).normalized();
      in_free_space += view.at(T_world_model * p - options.reach * toward) == DepthView::Space::free;
    }
    return explained * (1.0 - static_cast<double>(in_free_space) / static_cast<double>(model.size()));
  }
};

Pose best_pose(const Completion& scene, const std::vector<OrientedBox>& boxes, double model_bottom, const Search& search, Context& context) {
  std::vector<OrientedBox> model;
  for (const OrientedBox& box : boxes) model.push_back(lifted(box, -model_bottom));
  const std::vector<double> levels = levels_of(scene);
  Pose best;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    context.progress(static_cast<double>(l) / static_cast<double>(levels.size()));
    std::vector<OrientedBox> standing;
    for (const Cuboid& c : scene.cuboids) standing.push_back(lifted(c.box, -levels[l]));
    const SpectralMatch match = match_boxes(model, standing);
    for (RigidTransform T : alignments(model, standing, match.matches)) {
      T.translation.z() = levels[l] - model_bottom;
      const double score = search.score(T);
      if (score > best.score) best = {T, match.matches, score};
    }
  }
  return best;
}

void paste(const RgbdFrame& frame, const Completion& scene, const PointCloud& model, ScanCompletion& out) {
  out.completed = cloud_in_world(frame, scene.T_world_camera);
  out.completed.labels.assign(out.completed.size(), 0);
  const bool colored = !out.completed.colors.empty();
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (!model.positions[i].allFinite()) continue;
    out.completed.positions.push_back(out.T_world_model * model.positions[i]);
    out.completed.labels.push_back(1);
    if (colored) out.completed.colors.push_back(model.colors.empty() ? kPlain : model.colors[i]);
  }
}

}  // namespace

PointCloud cloud_in_world(const RgbdFrame& frame, const RigidTransform& T_world_camera) {
  PointCloud out;
  if (frame.is_fused()) {
    for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
      if (!frame.cloud.positions[i].allFinite()) continue;
      out.positions.push_back(T_world_camera * frame.cloud_point(i));
      if (!frame.cloud.colors.empty()) out.colors.push_back(frame.cloud.colors[i]);
    }
    return out;
  }
  const int w = frame.camera.width;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    if (!(frame.depth[i] > 0.0f)) continue;
    const int pixel = static_cast<int>(i);
    out.positions.push_back(T_world_camera * frame.camera.unproject(pixel % w, pixel / w, frame.depth[i]));
    if (!frame.color.empty()) out.colors.push_back(frame.color[i]);
  }
  return out;
}

ScanCompletion complete_scan(const RgbdFrame& frame, const Completion& scene, const PointCloud& model,
                             const ScanCompletionOptions& options, Context& context) {
  const std::vector<Vec3> points = usable_points(model);
  ScanCompletion out;
  out.model_boxes = fit_model_boxes(points, options.fill);
  const SampledSurface surface(every_nth(points, kModelPoints));
  const std::vector<Vec3> measured = cloud_in_world(frame, scene.T_world_camera).positions;
  std::vector<Vec3> of_cuboids;
  for (const Cuboid& c : scene.cuboids)
    for (const Vec3& p : points_of(c.box, scene, measured)) of_cuboids.push_back(p);

  const DepthView view(frame, scene.T_world_camera, options.noise);
  const std::vector<Vec3> few_of_model = every_nth(points, kFreePoints), few_of_scene = every_nth(of_cuboids, kScenePoints);
  double bottom = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) bottom = std::min(bottom, p.z());
  const Pose pose = best_pose(scene, out.model_boxes, bottom, {surface, few_of_model, few_of_scene, view, options}, context);
  if (pose.matches.empty()) return out;

  std::vector<Vec3> of_matches;
  for (const BoxMatch& match : pose.matches)
    for (const Vec3& p : points_of(scene.cuboids[match.cuboid].box, scene, measured)) of_matches.push_back(p);
  const Registration fit =
      register_upright(every_nth(of_matches, kRefinePoints), surface, pose.T_world_model.inverse(), options.reach);
  out.T_world_model = fit.T_target_source.inverse();
  out.rms = fit.rms;
  const auto on_model = std::count_if(of_matches.begin(), of_matches.end(), [&](const Vec3& p) {
    return surface.nearest(fit.T_target_source * p, options.reach).has_value();
  });
  out.explained = of_matches.empty() ? 0.0 : static_cast<double>(on_model) / static_cast<double>(of_matches.size());
  out.found = out.explained >= kLeastExplained;
  for (const BoxMatch& match : pose.matches) out.matches.push_back({match.model_box, scene.cuboids[match.cuboid].id});
  if (out.found) paste(frame, scene, model, out);
  return out;
}

}  // namespace unseen::cuboids
