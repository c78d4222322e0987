// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/stage/stage_cast.h"

#include <fmt/format.h>

#include "collision/solve/flight.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr double kTouching = 1e-4;  // m
constexpr double kFar = 0.01;       // m: bodies that a result has so far apart at their impact are worth a warning

/// A body of which only the size is known is a ball.
Body with_shape(Body body) {
  if (body.shape != Shape::size) return body;
  body.shape = Shape::sphere;
  body.radius = 0.5 * body.size;
  return body;
}

void check(const StagePlan& plan, const StagedCollision& c) {
  const auto fail = [&](const std::string& found, const std::string& expected) { throw InputError(plan.name, c.name, found, expected); };
  if (c.result.impacts.empty() || c.result.bodies.size() != 2) fail("a result without a collision", "one in which two bodies collide");
  if (c.shot.bodies.size() != 2) fail(fmt::format("a shot of {} bodies", c.shot.bodies.size()), "two");
  for (std::size_t i = 0; i < 2; ++i) {
    if (c.result.bodies[i].name != c.shot.bodies[i].name)
      fail(fmt::format("a body \"{}\" that the shot calls \"{}\"", c.result.bodies[i].name, c.shot.bodies[i].name), "the shot of the result");
    if (c.swaps[i] && c.result.bodies[i].fixed) fail(fmt::format("another shape for \"{}\", which is fixed", c.result.bodies[i].name), "a body that moves");
  }
  if (c.result.fixed.empty() && !c.result.mass_ratio) fail("a result without a mass ratio", "one with a mass ratio");
}

/// c of the first impact; the shot's pooled value stands for what is to be confident.
double restitution_of(const Reconstruction& r) { return std::clamp(r.impacts.front().restitution.value, 0.0, 1.0); }

/// kg
std::optional<double> first_mass(const StagedCollision& c) {
  if (c.mass) return *c.mass;
  if (c.shot.bodies[0].mass) return *c.shot.bodies[0].mass;
  if (c.shot.bodies[1].mass && c.result.mass_ratio) return *c.shot.bodies[1].mass / c.result.mass_ratio->value;
  return std::nullopt;
}

/// The state before the impact of unit mass, about principal axes. A body with another shape keeps its spin.
StageState filmed_state(const StagedCollision& c, std::size_t i, const Solid& solid) {
  const BodyState& before = c.result.bodies[i].before;
  const double mass = i == 0 || !c.result.mass_ratio ? 1.0 : c.result.mass_ratio->value;
  StageState s;
  s.p = before.p;
  s.v = before.v;
  s.h = before.k / mass;
  s.q = before.q * solid.file_to_principal.conjugate();
  if (c.swaps[i]) {
    const Solid filmed = solid_of(with_shape(c.shot.bodies[i]), c.shot.name);
    const Vec3 spin = angular_velocity<double>(before.q * filmed.file_to_principal.conjugate(), s.h, filmed.mass.inertia);
    s.h = s.q * (solid.mass.inertia.asDiagonal() * (s.q.conjugate() * spin));
  }
  return s;
}

CastActor actor_from(const StagedCollision& c, int collision, std::size_t i) {
  CastActor made;
  made.collision = collision;
  made.body = static_cast<int>(i);
  made.actor.body = with_shape(c.swaps[i] ? *c.swaps[i] : c.shot.bodies[i]);
  made.actor.name = c.name + "." + c.shot.bodies[i].name;
  made.actor.body.name = made.actor.name;
  made.solid = solid_of(made.actor.body, c.shot.name);
  made.actor.inertia = made.solid.mass.inertia;
  const std::optional<double> mass = first_mass(c);
  made.mass_known = mass.has_value();
  made.actor.mass = mass.value_or(1.0) * (i == 1 && c.result.mass_ratio ? c.result.mass_ratio->value : 1.0);
  made.actor.restitution = std::sqrt(restitution_of(c.result));
  made.actor.friction = std::sqrt(c.result.impacts.front().friction.value_or(0.0));
  made.impact = filmed_state(c, i, made.solid);
  return made;
}

/// Moves two bodies along their normal so that they touch at the impact.
void close_gap(StageState& a, const Solid& solid_a, StageState& b, const Solid& solid_b, const std::string& name, Context& context) {
  const auto near = nearest(solid_a, a.p, a.q, solid_b, b.p, b.q, kTouching);
  if (!near) return;
  a.p -= 0.5 * near->gap * near->normal;
  b.p += 0.5 * near->gap * near->normal;
  if (std::abs(near->gap) > kFar)
    context.warn(fmt::format("{}: the bodies {} by {:.0f} mm at their impact and were moved until they touch", name,
                             near->gap > 0 ? "miss each other" : "overlap", 1e3 * std::abs(near->gap)));
}

/// Other shapes touch elsewhere: what was estimated says nothing of them.
Vec3 rub_of(const StagedCollision& c) {
  const Impact& impact = c.result.impacts.front();
  if (c.swaps[0] || c.swaps[1]) return Vec3::Zero();
  return impact.impulse - impact.normal.dot(impact.impulse) * impact.normal;
}

/// What is fixed passes through where the body touches it.
Wall wall_from(const StagedCollision& c, int collision, const CastActor& a) {
  Wall wall;
  wall.name = c.name + "." + c.result.fixed;
  wall.collision = collision;
  wall.plane.normal = c.result.impacts.front().normal;
  wall.plane.offset = wall.plane.normal.dot(nearest_to_plane(a.solid, a.impact.p, a.impact.q, wall.plane.normal, kTouching).point_a);
  return wall;
}

void add_collision(Cast& cast, const StagePlan& plan, int index, Context& context) {
  const StagedCollision& c = plan.collisions[static_cast<std::size_t>(index)];
  check(plan, c);
  const int first = static_cast<int>(cast.actors.size());
  cast.actors.push_back(actor_from(c, index, 0));
  CastActor& a = cast.actors.back();
  CastPair pair = {first, first + 1, restitution_of(c.result), c.result.impacts.front().friction.value_or(0.0), c.time, -1, rub_of(c)};
  if (c.result.fixed.empty()) {
    CastActor b = actor_from(c, index, 1);
    close_gap(a.impact, a.solid, b.impact, b.solid, c.name, context);
    cast.actors.push_back(std::move(b));
  } else {
    cast.walls.push_back(wall_from(c, index, a));
    pair.b = -static_cast<int>(cast.walls.size());
  }
  cast.pairs.push_back(pair);
  for (std::size_t i = static_cast<std::size_t>(first); i < cast.actors.size(); ++i) cast.actors[i].impact.time = c.time;
  cast.placements.push_back({c.name, c.file, c.time, {}, 0, {}});
  if (c.result.drag) context.warn(fmt::format("{}: the new shot has no air drag", c.name));
}

RigidTransform about_vertical(const Vec3& center, double turn, const Vec3& translate) {
  RigidTransform T;
  T.rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  T.translation = center - T.rotation * center + translate;
  return T;
}

void move(StageState& s, const RigidTransform& T) {
  s.p = T * s.p;
  s.v = T.rotation * s.v;
  s.h = T.rotation * s.h;
  s.q = Quat(T.rotation) * s.q;
}

}  // namespace

Cast cast_of(const StagePlan& plan, Context& context) {
  Cast cast;
  cast.gravity = plan.gravity;
  if (plan.collisions.empty()) throw InputError(plan.name, "collision", "nothing", "at least one collision");
  for (int i = 0; i < static_cast<int>(plan.collisions.size()); ++i) {
    add_collision(cast, plan, i, context);
    const StagedCollision& c = plan.collisions[static_cast<std::size_t>(i)];
    place(cast, plan, i, c.translate, c.turn);
  }
  if (plan.floor) cast.walls.push_back({"floor", {Vec3::UnitZ(), *plan.floor}, -1});
  return cast;
}

StageState flown(const CastActor& actor, const StageState& from, double gravity, double time) {
  const double dt = time - from.time;
  const PointState<double> end = fly<double>({from.p, from.v}, Vec3(0, 0, -gravity), {}, dt);
  return {time, end.p, end.v, from.h, turned(from.q, from.h, actor.actor.inertia, dt)};
}

void place(Cast& cast, const StagePlan& plan, int collision, const Vec3& translate, double turn) {
  Placement& at = cast.placements[static_cast<std::size_t>(collision)];
  const Vec3& center = plan.collisions[static_cast<std::size_t>(collision)].result.impacts.front().contact_point;
  const RigidTransform T = about_vertical(center, turn, translate), change = T * at.T_new_filmed.inverse();
  at.translate = translate;
  at.turn = turn;
  at.T_new_filmed = T;
  for (CastActor& a : cast.actors)
    if (a.collision == collision) move(a.impact, change);
  for (CastPair& pair : cast.pairs)
    if (pair.meeting < 0 && cast.actors[static_cast<std::size_t>(pair.a)].collision == collision) pair.rub = change.rotation * pair.rub;
  for (Wall& w : cast.walls)
    if (w.collision == collision) {
      w.plane.normal = change.rotation * w.plane.normal;
      w.plane.offset += w.plane.normal.dot(change.translation);
    }
}

int actor_of(const Cast& cast, const StagedBody& body) {
  for (std::size_t i = 0; i < cast.actors.size(); ++i)
    if (cast.actors[i].collision == body.collision && cast.actors[i].body == body.body) return static_cast<int>(i);
  return -1;
}

std::string pair_name(const Cast& cast, int a, int b) {
  const auto name = [&](int i) { return i >= 0 ? cast.actors[static_cast<std::size_t>(i)].actor.name : cast.walls[static_cast<std::size_t>(-1 - i)].name; };
  return name(a) + " and " + name(b);
}

}  // namespace unseen::collision
