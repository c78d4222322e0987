// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/alternative.h"
#include "collision/doubts/scale_doubt.h"
#include "collision/doubts/shutter_doubt.h"
#include "collision/doubts/vertical.h"
#include "collision/shot_problem.h"
#include "collision/solve/drag.h"
#include "collision/solve/estimates.h"
#include "collision/solve/slowing.h"
#include "core/linear.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

void compare_scales(const Shot& shot, const std::vector<SolvedImpact>& impacts, Context& context) {
  for (int o = 0; o < 2; ++o) {
    if (shot.bodies[o].shape == Shape::fixed) continue;
    std::vector<double> ratios;
    for (const SolvedImpact& impact : impacts)
      if (const auto& ratio = impact.uncertain.scale[static_cast<std::size_t>(o)]) ratios.push_back(*ratio);
    if (ratios.empty()) continue;
    const double ratio = median(std::move(ratios));
    if (is_another_scale(impacts.front().solution.problem.solids[static_cast<std::size_t>(o)], ratio))
      context.warn(fmt::format("{}: the distance by its size is {:.3g} times that by gravity: {}its size is given {:.0f} % too {}, or the frame rate {:.0f} % too {}",
                               shot.bodies[o].name, ratio, ratio > 1.0 && !shot.video.empty() ? "only a part of it tells from the background, or " : "", 100.0 * std::abs(ratio - 1.0), ratio > 1.0 ? "large" : "small",
                               100.0 * std::abs(std::sqrt(ratio) - 1.0), ratio > 1.0 ? "high" : "low"));
  }
}

/// What the flights by themselves say of the vertical, where that is clearly not what is given; or nothing.
std::optional<Vec3> down_of_flights(const std::vector<SolvedImpact>& impacts, const Vec3& given, double wrong) {
  constexpr double kSignificant = 16.0;  // χ²
  Vertical seen;
  for (SolvedImpact impact : impacts) {
    add_covariance(impact.solution.problem, impact.solution.fit);
    seen.add(seen_vertical(impact.solution.problem, impact.solution.fit), 1.0 / static_cast<double>(impacts.size()));
  }
  const Vec3 found = likeliest(seen, impacts.front().solution.fit.state.down).first;
  const auto unlikely = [&](const Vec3& down) { return down.dot(seen.precision * down) - 2.0 * seen.sum.dot(down); };
  return angle_between(given, found) > wrong && unlikely(given) - unlikely(found) > kSignificant ? std::optional(found) : std::nullopt;
}

/// A floor whose normal is given, and by the flights leans from the vertical: it slopes, or the normal is wrong.
void check_normal(const Shot& shot, const std::vector<SolvedImpact>& impacts, Context& context) {
  const double sloping = radians(8.0);
  const std::optional<GivenDown> given = given_down(shot);
  if (shot.down || !given || shot.gravity == 0.0) return;
  if (const auto found = down_of_flights(impacts, given->down, sloping))
    context.warn(fmt::format("{}: by the flights the normal of {} leans by {:.0f}° from the vertical: if it is level, its normal is given wrong; if it slopes, give \"down\" too", shot.name, shot.bodies[1].name,
                             degrees(angle_between(given->down, *found))));
}

/// What the shot says of down is held on to, but flights by themselves may say otherwise. `by_drag`: χ² that drag of the air saves; it looks like gravity that leans back.
void check_down(const Shot& shot, const std::vector<SolvedImpact>& impacts, double by_drag, Reconstruction& result, Context& context) {
  constexpr double kWrong = 0.05;         // rad
  constexpr double kSignificant = 16.0;   // χ²
  if (!shot.down || shot.gravity == 0.0) return;
  const Vec3 given = shot.down->normalized();
  const std::optional<Vec3> found = down_of_flights(impacts, given, kWrong);
  if (!found) return;
  std::vector<SolvedImpact> freed = impacts;
  double saved = 0.0;  // χ²
  for (SolvedImpact& impact : freed) {
    const double before = impact.solution.fit.cost;
    impact.solution.problem.down = *found;
    impact.solution.problem.down_sigma = kDownSigma;
    impact.solution.fit = settle(impact.solution.problem, impact.solution.fit.state);
    if (!impact.solution.fit.usable) return;
    saved += 2.0 * (before - impact.solution.fit.cost);
  }
  if (!(saved > by_drag + kSignificant)) return;
  context.warn(fmt::format("{}: down: by the flights gravity points {:.0f}° away from where it is given", shot.name, degrees(angle_between(given, *found))));
  add_alternative("with gravity as the flights have it", freed, saved, result);
}

/// Without gravity all is taken to move in a plane parallel to the image, and then each body looks as large everywhere.
void check_parallel(const Shot& shot, const Camera& camera, const Tracks& tracks, Context& context) {
  const double slanting = shot.video.empty() ? 0.01 : 0.08;  // share of the size; blur and shadows change that of regions
  constexpr double kSignificant = 16.0;                      // χ²
  constexpr std::size_t kFewest = 12;
  if (shot.gravity != 0.0) return;
  std::vector<const TrackPoint*> sized;
  for (const TrackPoint& p : tracks.points)
    if (p.diameter > 0.0) sized.push_back(&p);
  if (sized.size() < kFewest) return;
  // The log of the size: of each body, what distance from the axis adds (spheres are seen as ellipses there), and how it changes over the picture.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(sized.size()), 5);
  Eigen::VectorXd size(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const TrackPoint& p = *sized[static_cast<std::size_t>(i)];
    rows(i, p.body) = 1.0;
    const Vec2 off((p.pixel.x() - camera.cx) / camera.fx, (p.pixel.y() - camera.cy) / camera.fy);
    rows(i, 2) = off.squaredNorm();
    rows.row(i).tail<2>() = off.transpose();
    size[i] = std::log(p.diameter);
  }
  const auto fit_of = [&](const Eigen::MatrixXd& columns) { return least_norm(columns, size); };
  const Eigen::MatrixXd level = rows.leftCols<3>();
  const Eigen::VectorXd fit = fit_of(rows), seen = rows.rightCols<2>() * fit.tail<2>();
  const double squares = (rows * fit - size).squaredNorm(), without = (level * fit_of(level) - size).squaredNorm();
  const double change = seen.maxCoeff() - seen.minCoeff(), variance = squares / static_cast<double>(rows.rows() - rows.cols());
  if (change > slanting && without - squares > kSignificant * variance)
    context.warn(fmt::format("{}: sizes change by {:.1f} % across what was seen: without gravity all must move in a plane parallel to the image, and restitution and mass ratio are off by about as much if it does not", shot.name, 100.0 * change));
}

/// Bodies are told apart by their sizes, if nobody labelled them: sizes that are alike tell little, and where none was seen the mass ratio might
/// as well be the other way round.
void doubt_labels(const Shot& shot, const Tracks& tracks, const SolvedImpact& impact, Reconstruction& result, Context& context) {
  constexpr double kAlike = 0.15;  // share
  const auto& solids = impact.solution.problem.solids;
  if (tracks.told_apart || impact.solution.problem.fixed || !result.mass_ratio) return;
  const bool sized = std::any_of(tracks.points.begin(), tracks.points.end(), [](const TrackPoint& p) { return p.diameter > 0.0; });
  if (sized && std::abs(std::log(solids[0].mass.extent / solids[1].mass.extent)) > kAlike) return;
  const std::string &a = shot.bodies[0].name, &b = shot.bodies[1].name;
  context.warn(sized ? fmt::format("{} and {} are alike in size: they may have been taken for each other", a, b)
                     : fmt::format("no label and no size tells {} from {}: the mass ratio may be the other way round", a, b));
  for (const double m : {result.mass_ratio->value, 1.0 / result.mass_ratio->value})
    if (!sized || m != result.mass_ratio->value)
      result.ambiguous.push_back({"the two bodies taken for each other", impact.uncertain.restitution.value, m, 0.0});
  if (!sized) result.mass_ratio.reset();
}

/// Says why impacts are left out, or why the model does not fit: at the first one that it does not fit at, and at how many others. Whether there are any.
bool warn_of_refused(const std::vector<SolvedImpact>& impacts, const Reconstruction& result, Context& context) {
  std::size_t refused = 0;
  for (const SolvedImpact& impact : impacts) refused += !impact.check.reasons.empty();
  const std::string others = refused > 1 ? fmt::format(" (nor at {} other impact{})", refused - 1, refused == 2 ? "" : "s") : "";
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    for (const std::string& reason : impacts[i].check.reasons)
      context.warn(result.fits ? fmt::format("the impact at frame {:.1f} is left out: {}", result.impacts[i].frame, reason) : fmt::format("the model does not fit{}: {}", others, reason));
    if (!result.fits && !impacts[i].check.reasons.empty()) break;
  }
  return refused > 0;
}

}  // namespace

void warn_of_camera(const ShotCamera& camera, bool told, Context& context) {
  if (!camera.assumed) return;
  const double fov = degrees(2.0 * std::atan(0.5 * camera.camera.width / camera.camera.fx));
  const std::string how = fmt::format("focal length {:.0f} px, {:.0f}° across", camera.camera.fx, fov);
  context.warn(told ? fmt::format("the camera's focal length is estimated from the flights: {}", how)
                    : fmt::format("the camera's intrinsics are assumed: {}; distances scale with it, and intervals are wider for it", how));
}

void warn_of_footage(const Footage& footage, Context& context) {
  if (footage.moving_camera) context.warn("the camera moves more than can be undone; film from a tripod");
}

void warn_of_dimmed(const Shot& shot, const Footage& footage, const Tracks& tracks, Context& context) {
  constexpr double kMuch = 0.03;  // of what differs from the background
  if (footage.regions.empty()) return;
  for (int o = 0; o < 2; ++o) {
    if (shot.bodies[o].shape == Shape::fixed || shot.bodies[o].shape == Shape::sphere) continue;
    double sum = 0.0, count = 0.0;
    for (const TrackPoint& p : tracks.points)
      if (p.body == o && p.region >= 0) sum += footage.regions[static_cast<std::size_t>(p.frame)][static_cast<std::size_t>(p.region)].dimmed, ++count;
    if (sum > kMuch * count)
      context.warn(fmt::format("{}: what is merely darker than the background beside it, {:.0f} % of what differs from that, is taken for its shadow; where that is its own shaded side the result is wrong. A background "
                               "of another colour, or with texture, tells them apart", shot.bodies[o].name, 100.0 * sum / count));
  }
}

void remark_on(const Shot& shot, const Options& options, const Tracks& tracks, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context) {
  doubt_labels(shot, tracks, impacts.front(), result, context);
  compare_scales(shot, impacts, context);
  check_parallel(shot, impacts.front().solution.problem.camera, tracks, context);
  const bool several = result.fixed.empty() && tracks.collisions_seen > 1;
  if (several) context.warn(fmt::format("{} collisions of free bodies were seen, the model is of one: cut the clip (\"frames\")", tracks.collisions_seen));
  const bool refused = warn_of_refused(impacts, result, context);
  if (!result.fits && !refused)
    context.warn("no confident restitution: it ends on a bound, 0 or 1");
  if (result.fits && !result.restitution && !several)
    context.warn("no confident restitution: the flights tell too little of it");
  const double by_drag = look_for_drag(shot, options, impacts, result, context);
  add_doubt_of_slowing(impacts, result);
  check_down(shot, impacts, by_drag, result, context);
  check_normal(shot, impacts, context);
  doubt_shutter(shot, impacts, result, context);
}

}  // namespace unseen::collision
