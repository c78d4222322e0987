// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "collision/synth/synth_plan.h"

namespace unseen::collision {
namespace {

constexpr int kOutline = 64;           // corners of a ball's outline
constexpr double kWatched = 0.35;      // s on each side of the impact that must be seen well
constexpr double kInside = 0.75, kApart = 0.4;  // shares of the frames there
constexpr double kBeside = 0.08;       // s there that each body is seen whole beside a curtain
constexpr double kCurtain = 1.2;       // half its width, of the larger body's reach

/// A circle of directions that touch a ball, as seen from the origin, in camera coordinates.
std::vector<Vec2> ball_outline(double radius, const Vec3& center, const Camera& camera) {
  const double distance = center.norm(), sine = radius / distance;
  const Vec3 axis = center / distance, across = any_orthogonal(axis), up = axis.cross(across);
  std::vector<Vec2> outline;
  for (int i = 0; i < kOutline; ++i) {
    const double angle = 2 * kPi * i / kOutline;
    const Vec3 side = std::cos(angle) * across + std::sin(angle) * up;
    outline.push_back(camera.project(std::sqrt(1 - sine * sine) * axis + sine * side));
  }
  return outline;
}

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * std::abs(twice);
}

bool in_picture(const Vec2& p, double margin, const Camera& camera) {
  return p.x() >= margin && p.y() >= margin && p.x() <= camera.width - 1 - margin && p.y() <= camera.height - 1 - margin;
}

/// Random rotation by an angle of standard deviation `sigma`.
Quat jolt(double sigma, Random& random) {
  const Vec3 axis = random.direction();
  return Quat(Eigen::AngleAxisd(sigma * random.normal(), axis));
}

/// Index of the flight that a time lies in: how many impacts came before.
std::size_t flight_of(const Truth& truth, double time) {
  std::size_t flight = 0;
  while (flight < truth.impacts.size() && truth.impacts[flight].time < time) ++flight;
  return flight;
}

/// Whether nobody looks: near an impact, if the options leave a gap there.
bool in_gap(const Truth& truth, const FramePose& f, int gap) {
  return std::any_of(truth.impacts.begin(), truth.impacts.end(), [&](const Impact& i) { return std::abs(f.frame - i.frame) <= 0.5 * gap; });
}

void observe_orientations(const Truth& truth, int body, const SynthOptions& options, const RigidTransform& T_camera_world,
                          Random& random, Shot& shot) {
  std::vector<std::vector<const FramePose*>> flights(truth.impacts.size() + 1);
  for (const FramePose& f : truth.frames) {
    const bool seen = in_picture(truth.camera.project(T_camera_world * f.bodies[body]->p), 0, truth.camera);
    if (seen && !in_gap(truth, f, options.gap)) flights[flight_of(truth, f.time)].push_back(&f);
  }
  for (const auto& flight : flights)
    for (int i = 0; i < options.orientations && !flight.empty(); ++i) {
      const auto at = static_cast<std::size_t>((i + 0.5) / options.orientations * static_cast<double>(flight.size()));
      const Quat q = Quat(T_camera_world.rotation) * flight[at]->bodies[body]->q;
      shot.orientations.push_back({body, flight[at]->time, q * jolt(radians(options.orientation_noise), random)});
    }
}

}  // namespace

std::vector<Vec2> silhouette(const SynthBody& body, const SynthPose& pose, const Camera& camera, const RigidTransform& T_world_camera) {
  const RigidTransform T = T_world_camera.inverse();
  if (body.sphere()) return ball_outline(body.radius, T * pose.p, camera);
  std::vector<cv::Point2f> corners, hull;
  for (const Vec3& v : body.vertices) {
    const Vec2 p = camera.project(T * (pose.p + pose.q * v));
    corners.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  cv::convexHull(corners, hull);
  std::vector<Vec2> outline;
  for (const cv::Point2f& p : hull) outline.push_back({p.x, p.y});
  return outline;
}

std::array<int, 2> curtain_columns(const std::vector<SynthMover>& movers, const Vec3& contact, const Camera& camera) {
  double reach = 0;
  for (const SynthMover& m : movers) reach = std::max(reach, m.body.reach);
  const double half = kCurtain * camera.fx * reach / contact.z(), middle = camera.project(contact).x();
  const auto column = [&](double u) { return std::clamp(static_cast<int>(u), 0, camera.width); };
  return {column(middle - half), column(middle + half)};
}

bool well_seen(const SynthPlan& plan, const SynthOptions& options, const Truth& truth) {
  if (!plan.watched) return true;
  const RigidTransform T = plan.T_world_camera.inverse();
  const bool curtain = options.curtain && !truth.impacts.empty();
  const auto [left, right] = curtain ? curtain_columns(plan.movers, T * truth.impacts.front().contact_point, plan.camera) : std::array{0, 0};
  int frames[2] = {}, inside[2] = {}, apart[2] = {}, beside[2][2] = {};
  for (const FramePose& f : truth.frames) {
    if (std::abs(f.time - plan.time) > kWatched) continue;
    const int side = f.time < plan.time ? 0 : 1;
    bool all = true;
    double reach = 0;
    for (std::size_t i = 0; i < plan.movers.size(); ++i) {
      const Vec3 p = T * f.bodies[i]->p;
      const double radius = plan.camera.fx * plan.movers[i].body.reach / p.z(), u = plan.camera.project(p).x();
      const bool whole = p.z() > 0.8 && in_picture(plan.camera.project(p), radius, plan.camera);
      all = all && whole;
      beside[side][i] += whole && (u + radius < left || u - radius > right);
      reach += radius;
    }
    ++frames[side];
    inside[side] += all;
    const bool two = plan.movers.size() == 2;
    apart[side] += !two || (plan.camera.project(T * f.bodies[0]->p) - plan.camera.project(T * f.bodies[1]->p)).norm() > reach;
  }
  for (int side = 0; side < 2; ++side) {
    if (frames[side] == 0 || inside[side] < kInside * frames[side] || apart[side] < kApart * frames[side]) return false;
    for (std::size_t i = 0; curtain && i < plan.movers.size(); ++i)
      if (beside[side][i] < kBeside * options.fps) return false;
  }
  return true;
}

void observe(const Truth& truth, const SynthOptions& options, Shot& shot) {
  Random random(static_cast<std::uint64_t>(options.seed) * 7 + 1);
  const RigidTransform T = truth.T_world_camera.inverse();
  std::vector<SynthBody> bodies;
  for (const Body& b : truth.bodies)
    if (b.shape != Shape::fixed) bodies.push_back(synth_body(b));
  for (const FramePose& f : truth.frames) {
    double radius[2] = {}, noise = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      radius[i] = std::sqrt(area_of(silhouette(bodies[i], {f.bodies[i]->p, f.bodies[i]->q}, truth.camera, truth.T_world_camera)) / kPi);
      noise = std::max(noise, options.centroid_noise * 2 * radius[i]);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Vec2 exact = truth.camera.project(T * f.bodies[i]->p);
      const double du = random.uniform(-1, 1), dv = random.uniform(-1, 1);
      if (!in_gap(truth, f, options.gap) && in_picture(exact, 0, truth.camera))
        shot.observations.push_back({f.frame, exact + noise * Vec2(du, dv), radius[i], static_cast<int>(i)});
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].sphere()) observe_orientations(truth, static_cast<int>(i), options, T, random, shot);
}

}  // namespace unseen::collision
