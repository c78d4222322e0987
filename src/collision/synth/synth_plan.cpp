// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/synth/synth_plan.h"

#include <algorithm>

#include "collision/synth/synth_contact.h"

namespace unseen::collision {
namespace {

constexpr double kFocal = 1000.0 / 1280.0;  // of the picture's width
constexpr double kAirDensity = 1.2;         // kg/m³
constexpr double kSphereDrag = 0.47;        // Cd

Body box(const std::string& name, const Vec3& size) {
  Body b;
  b.name = name;
  b.shape = Shape::box;
  b.box = size;
  return b;
}

Body ball(const std::string& name, double radius) {
  Body b;
  b.name = name;
  b.radius = radius;
  return b;
}

Body prism(const std::string& name, Random& random) {
  Body b;
  b.name = name;
  b.shape = Shape::mesh;
  b.mesh = synth_mesh(random);
  return b;
}

Body draw_box(const std::string& name, Random& random, bool elongated) {
  if (elongated) return box(name, {random.uniform(0.2, 0.3), random.uniform(0.07, 0.11), random.uniform(0.07, 0.11)});
  const double x = random.uniform(0.08, 0.22), y = random.uniform(0.08, 0.2), z = random.uniform(0.08, 0.2);
  return box(name, {x, y, z});
}

/// The camera looks along y, with its own "down" up to a few degrees beside gravity.
void place_camera(SynthPlan& plan, const SynthOptions& options, double pitch, double roll) {
  const double f = kFocal * options.width;
  plan.camera = {f, f, 0.5 * (options.width - 1), 0.5 * (options.height - 1), options.width, options.height};
  Mat3 level;
  level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  plan.T_world_camera.rotation = Eigen::AngleAxisd(pitch, Vec3::UnitX()) * level * Eigen::AngleAxisd(roll, Vec3::UnitZ());
}

/// World coordinates of a place in the picture, as shares of its width and height.
Vec3 place(const SynthPlan& plan, double u, double v, double depth) {
  return plan.T_world_camera * plan.camera.unproject(u * plan.camera.width, v * plan.camera.height, depth);
}

/// When the first contact is and how long the shot lasts.
void set_time(SynthPlan& plan, const SynthOptions& options, double before, double after, Random& random) {
  const double shift = random.uniform(-0.1, 0.1);
  plan.frames = options.frames > 0 ? options.frames : static_cast<int>(std::ceil((before + after) * options.fps));
  plan.time = options.frames > 0 ? (before / (before + after) + shift) * options.frames / options.fps : before;
}

void draw_common(SynthPlan& plan, const SynthOptions& options, double least_restitution, Random& random) {
  plan.restitution = random.uniform(least_restitution, 0.85);
  if (options.restitution) plan.restitution = *options.restitution;
  plan.floor_restitution = plan.restitution;
}

void add_mover(SynthPlan& plan, const Body& body, double mass) {
  plan.bodies.push_back(body);
  plan.movers.push_back({synth_body(body), mass, 0.0});
  plan.states.emplace_back();
}

void set_spin(const SynthOptions& options, double least, double most, SynthPlan& plan, Random& random) {
  for (SynthState& s : plan.states) {
    const double drawn = random.uniform(least, most);
    s.w = s.q.conjugate() * (options.spin.value_or(drawn) * random.direction());
  }
  plan.most_spin = std::max(plan.most_spin, 2 * options.spin.value_or(0.0));
}

std::vector<Body> draw_bodies(const std::string& scene, Random& random) {
  if (scene == "box-ball") return {draw_box("box", random, false), ball("ball", random.uniform(0.06, 0.12))};
  if (scene == "balls" || scene == "planar" || scene == "rain")
    return {ball("red", random.uniform(0.05, 0.11)), ball("blue", random.uniform(0.05, 0.11))};
  if (scene == "offcentre") return {draw_box("red", random, true), draw_box("blue", random, true)};
  if (scene == "mesh") return {prism("red", random), prism("blue", random)};
  return {draw_box("red", random, false), draw_box("blue", random, false)};
}

/// Two free bodies that touch at `point`; they come from left and right.
void place_pair(SynthPlan& plan, const Vec3& point, const Vec3& normal, Random& random) {
  const auto centers = touch(plan.movers[0].body, plan.movers[1].body, normal, random, plan.states[0].q, plan.states[1].q);
  plan.hit = SynthHit{};
  plan.hit->point = point;
  plan.hit->normal = normal;
  for (std::size_t i = 0; i < 2; ++i) plan.states[i].p = point + centers[i];
}

/// Velocities with a relative speed along the normal, one across, and a common part.
void set_velocities(SynthPlan& plan, const Vec3& approach, const Vec3& common) {
  const double share = 0.5;  // of the approach, by each
  plan.states[0].v = common + share * approach;
  plan.states[1].v = common - (1 - share) * approach;
}

SynthPlan draw_pair(const SynthOptions& options, Random& random) {
  SynthPlan plan;
  const bool planar = options.scene == "planar", spinning = options.scene == "spin", offcentre = options.scene == "offcentre";
  draw_common(plan, options, 0.2, random);
  const double pitch = random.uniform(-0.09, 0.05), roll = random.uniform(-0.05, 0.05), ratio = random.uniform(0.6, 2.0);
  place_camera(plan, options, planar ? 0.0 : pitch, planar ? 0.0 : roll);
  if (planar) plan.gravity.setZero();
  const std::vector<Body> bodies = draw_bodies(options.scene, random);
  add_mover(plan, bodies[0], 1.0);
  add_mover(plan, bodies[1], options.mass_ratio.value_or(ratio));

  const double depth = planar ? random.uniform(1.4, 2.0) : random.uniform(1.7, 2.8);
  const double u = random.uniform(0.42, 0.58), v = planar ? random.uniform(0.4, 0.6) : random.uniform(0.25, 0.42);
  const double into = planar ? 0.0 : 1.0;  // nothing leaves the table
  const Vec3 normal = Vec3(-1, into * random.uniform(-0.35, 0.35), random.uniform(-0.4, 0.4)).normalized();
  place_pair(plan, place(plan, u, v, depth), normal, random);
  const double slow = planar ? 0.7 : 1.0, speed = slow * random.uniform(1.8, 3.6);
  const Vec3 across(0, into * random.uniform(-0.4, 0.4), random.uniform(-1, 1));
  const Vec3 common(random.uniform(-0.4, 0.4), into * random.uniform(-0.2, 0.2), planar ? 0.0 : random.uniform(-0.6, 1.2));
  set_velocities(plan, -speed * normal + slow * across, common);
  set_spin(options, spinning ? 8.0 : 0.5, spinning ? 18.0 : 4.0, plan, random);
  if (planar)
    for (SynthState& s : plan.states) s.w = s.q.conjugate() * Vec3(0, s.w.norm(), 0);
  plan.least_approach = planar ? 0.7 : 1.0;
  plan.most_spin = offcentre || spinning ? plan.most_spin : std::max(15.0, 2 * options.spin.value_or(0.0));
  if (offcentre) plan.least_spin = 8.0;
  set_time(plan, options, random.uniform(0.27, 0.4), random.uniform(0.32, 0.45), random);
  return plan;
}

/// The same two boxes, but one passes above the other.
SynthPlan draw_flight(const SynthOptions& options, Random& random) {
  SynthPlan plan = draw_pair(options, random);
  plan.hit.reset();
  plan.states[0].p.z() += 0.2;
  plan.states[1].p.z() -= random.uniform(0.15, 0.3);
  return plan;
}

void add_floor(SynthPlan& plan) {
  Body fixed;
  fixed.name = "floor";
  fixed.shape = Shape::fixed;
  fixed.normal = plan.T_world_camera.rotation.transpose() * Vec3::UnitZ();
  plan.bodies.push_back(fixed);
}

/// One body thrown onto a floor that the camera looks at from somewhat above.
SynthPlan draw_floor(const SynthOptions& options, Random& random) {
  SynthPlan plan;
  const bool is_box = options.scene == "box-floor", drag = options.scene == "drag";
  draw_common(plan, options, is_box ? 0.3 : 0.6, random);
  const double pitch = random.uniform(-0.14, -0.07), roll = random.uniform(-0.04, 0.04);
  place_camera(plan, options, pitch, roll);
  if (is_box)
    add_mover(plan, draw_box("box", random, false), 1.0);
  else
    add_mover(plan, ball("ball", drag ? random.uniform(0.09, 0.13) : random.uniform(0.04, 0.1)), 1.0);
  if (drag) {
    const double mass = random.uniform(0.04, 0.1), radius = plan.bodies[0].radius;
    plan.bodies[0].mass = mass;
    plan.movers[0].drag = 0.5 * kAirDensity * kSphereDrag * kPi * radius * radius / mass;
  }
  add_floor(plan);
  const bool from_left = random.uniform() < 0.5;
  const double u = is_box ? random.uniform(0.4, 0.6) : random.uniform(0.18, 0.3);
  const Vec3 point = place(plan, from_left ? u : 1 - u, random.uniform(0.78, 0.86), random.uniform(2.2, 3.2));
  plan.floor = Plane{Vec3::UnitZ(), point.z()};
  SynthState& s = plan.states[0];
  s.p = point + show_corner(plan.movers[0].body, -Vec3::UnitZ(), random, s.q);
  const double sideways = is_box ? random.uniform(0.4, 1.2) : random.uniform(0.4, 0.9);
  s.v = Vec3(from_left ? sideways : -sideways, random.uniform(-0.2, 0.2), -random.uniform(3.0, 3.8));
  plan.hit = SynthHit{};
  plan.hit->point = point;
  set_spin(options, 0.5, 5.0, plan, random);
  plan.least_impacts = is_box || plan.restitution < 0.55 ? 1 : 3;
  plan.once = is_box;
  plan.least_after = is_box && options.frames == 0 ? std::min(0.22, 0.44 * plan.restitution) : 0.0;
  set_time(plan, options, 0.28, is_box ? random.uniform(0.3, 0.4) : 1.1, random);
  return plan;
}

/// Two balls one above the other over a floor, which is not part of the shot: the lower one bounces back into the upper one.
SynthPlan draw_rain(const SynthOptions& options, Random& random) {
  SynthPlan plan;
  draw_common(plan, options, 0.6, random);
  plan.floor_restitution = 0.9;
  const double pitch = random.uniform(-0.12, -0.05), ratio = random.uniform(0.6, 2.0);
  place_camera(plan, options, pitch, random.uniform(-0.04, 0.04));
  const std::vector<Body> bodies = draw_bodies(options.scene, random);
  add_mover(plan, bodies[0], 1.0);
  add_mover(plan, bodies[1], options.mass_ratio.value_or(ratio));
  const Vec3 point = place(plan, random.uniform(0.4, 0.6), random.uniform(0.4, 0.55), random.uniform(2.4, 3.2));
  place_pair(plan, point, Vec3(random.uniform(-0.06, 0.06), random.uniform(-0.03, 0.03), 1).normalized(), random);
  set_velocities(plan, Vec3(0, 0, -random.uniform(2.0, 4.0)), Vec3(random.uniform(-0.2, 0.2), 0, random.uniform(-0.5, 1.0)));
  plan.floor = Plane{Vec3::UnitZ(), plan.states[1].p.z() - bodies[1].radius - random.uniform(0.25, 0.5)};
  set_spin(options, 0.5, 4.0, plan, random);
  plan.least_impacts = plan.restitution < 0.3 ? 1 : 2;
  plan.watched = false;
  set_time(plan, options, 0.2, 0.8, random);
  return plan;
}

}  // namespace

SynthPlan draw_plan(const SynthOptions& options, Random& random) {
  if (options.scene == "flight") return draw_flight(options, random);
  if (options.scene == "rain") return draw_rain(options, random);
  if (options.scene == "ball-floor" || options.scene == "box-floor" || options.scene == "drag") return draw_floor(options, random);
  return draw_pair(options, random);
}

}  // namespace unseen::collision
