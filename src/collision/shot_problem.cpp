// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/shot_problem.h"

#include <fmt/format.h>

#include <cmath>

#include "collision/doubts/size_trend.h"
#include "collision/tracks/at_rest.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr double kAir = 1.2;              // kg/m³
constexpr double kSphereSize = 0.04;      // share by which all projected sizes of a flight may be off together
constexpr double kOtherSize = 0.12;       // the same where the projected size depends on the orientation
constexpr double kDownGivenSigma = 0.01;  // rad, of a direction that the shot gives
constexpr double kFloor = 0.5;            // rad off up: a given normal that is no farther is a floor's, and
constexpr double kLevelSigma = 0.02;      // rad, floors are level

void add_points(const Tracks& tracks, int span_index, bool after, const ShotCamera& camera, const std::array<Solid, 2>& solids, Problem& problem) {
  const FlightSpan& span = tracks.spans[span_index];
  const Solid& solid = solids[span.body];
  const double sigma = (solid.is_sphere() ? kSphereSize : kOtherSize) * std::sqrt(static_cast<double>(span.end - span.begin));
  for (std::size_t i = span.begin; i < span.end; ++i) {
    const TrackPoint& p = tracks.points[i];
    PointObservation seen{span.body, after, p.frame, p.time, p.pixel, 0.0, sigma, p.row};
    if (p.diameter > 0.0) seen.depth = camera.camera.fx * solid.mass.extent / p.diameter;
    problem.points.push_back(seen);
  }
}

std::optional<Vec3> fixed_normal(const Shot& shot) {
  return shot.bodies[1].normal ? shot.bodies[1].normal : shot.floor ? std::optional(shot.floor->normal) : std::nullopt;
}

}  // namespace

std::optional<GivenDown> given_down(const Shot& shot) {
  if (shot.down) return GivenDown{*shot.down, kDownGivenSigma};
  const std::optional<Vec3> normal = shot.bodies[1].shape == Shape::fixed ? fixed_normal(shot) : std::nullopt;
  if (!normal || line_angle(*normal, -Vec3::UnitY()) >= kFloor || normal->y() >= 0.0) return std::nullopt;
  return GivenDown{-*normal, kLevelSigma};
}

ShotCamera complete_camera(const Shot& shot, int width, int height) {
  ShotCamera c = shot.camera;
  Camera& k = c.camera;
  if (k.width == 0) k.width = width, k.height = height;
  if (width > 0 && (k.width != width || k.height != height))
    throw InputError(shot.name, "camera", fmt::format("a size of {} × {}", k.width, k.height), fmt::format("{} × {}, as the video has", width, height));
  if (k.width <= 0) throw InputError(shot.name, "camera", "no image size", "width and height, or a video");
  if (k.fx <= 0.0) {
    k.fx = k.fy = 0.5 * k.width / std::tan(0.5 * c.hfov.value_or(radians(60.0)));
    k.cx = 0.5 * (k.width - 1);
    k.cy = 0.5 * (k.height - 1);
  }
  return c;
}

double drag_of(const Body& body, const Solid& solid, double drag_coefficient) {
  if (!body.mass || solid.mass.extent <= 0.0) return 0.0;
  return 0.5 * kAir * drag_coefficient * kPi / 4.0 * solid.mass.extent * solid.mass.extent / *body.mass;
}

Problem problem_of(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids, const Tracks& tracks,
                   const Tracks::Meeting& meeting) {
  Problem problem;
  problem.camera = camera.camera;
  problem.focal_assumed = camera.assumed;
  problem.gravity = shot.gravity;
  const GivenDown down = given_down(shot).value_or(GivenDown{Vec3::UnitY(), kDownSigma});
  problem.down = down.down;
  problem.down_sigma = down.sigma;
  problem.solids = solids;
  problem.fixed = shot.bodies[1].shape == Shape::fixed;
  problem.planar = shot.gravity == 0.0;
  problem.friction = options.friction;
  problem.terms = terms_of(options.physics, options.without);
  problem.pixel_sigma = std::max(0.1, tracks.noise);
  problem.filmed = !shot.video.empty();
  problem.orientation_sigma = radians(options.orientation_noise);
  if (problem.fixed) problem.fixed_normal = fixed_normal(shot);
  if (problem.fixed && shot.floor && !shot.bodies[1].normal) problem.fixed_offset = shot.floor->offset;
  if (options.fix_mass_ratio && !problem.fixed) {
    if (!shot.bodies[0].mass || !shot.bodies[1].mass) throw InputError(shot.name, "bodies", "no mass", "the mass of both bodies, for fix_mass_ratio");
    problem.mass_ratio = *shot.bodies[1].mass / *shot.bodies[0].mass;
  }
  if (options.drag == "on")
    for (int o = 0; o < 2; ++o) problem.drag[o] = drag_of(shot.bodies[o], solids[o], options.drag_coefficient);
  for (const int span : meeting.before) add_points(tracks, span, false, camera, solids, problem);
  for (const int span : meeting.after) add_points(tracks, span, true, camera, solids, problem);
  problem.rests = at_rest(problem);
  if (problem.planar && shot.metres_per_pixel)
    for (PointObservation& p : problem.points) p.depth = camera.camera.fx * *shot.metres_per_pixel, p.depth_sigma = 1e-3;
  if (!problem.planar && (problem.filmed || problem.fixed)) problem.trends = size_trends(problem);  // of two bodies momentum tells more
  return problem;
}

}  // namespace unseen::collision
