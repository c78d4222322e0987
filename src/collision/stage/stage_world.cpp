// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/stage/stage_world.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "collision/solve/rotation.h"
#include "collision/stage/bullet_world.h"

namespace unseen::collision {
namespace {

constexpr double kLongestStep = 1.0 / 9600;  // s: a body at 5 m/s goes half a millimetre
constexpr double kSameImpact = 1e-3;          // s: contacts of a pair in quicker succession are one impact, with the values of the hardest
constexpr double kSlowestImpact = 0.05;             // m/s: slower contacts are no impacts
constexpr double kSameTime = 2e-5;            // s: what an animation tells apart

std::unique_ptr<btCollisionShape> shape_of(const Solid& solid) {
  if (solid.is_sphere()) return std::make_unique<btSphereShape>(solid.radius);
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : solid.hull.vertices) hull->addPoint(bullet(v), false);
  hull->recalcLocalAabb();
  hull->setMargin(0);
  return hull;
}

/// The simulation under way. Between contacts a body's angular momentum is constant (Bullet's own step would lose some), and its
/// velocity is that of half a step before, so that its positions lie on the parabola.
class Simulation {
 public:
  Simulation(const Cast& cast, double step)
      : cast_(cast), step_(step), dispatcher_(&configuration_), world_(cast, &dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity({0, 0, -cast.gravity});
    for (std::size_t i = 0; i < cast.actors.size(); ++i) add(cast.actors[i], static_cast<int>(i));
    for (std::size_t w = 0; w < cast.walls.size(); ++w) add(cast.walls[w], -1 - static_cast<int>(w));
  }
  ~Simulation() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void advance(StageRun& run) {
    const std::vector<Turning> before = turn_freely();
    const StagedFrame now = frame();
    world_.stepSimulation(step_, 0);
    for (std::size_t i = 0; i < momenta_.size(); ++i)
      momenta_[i] += before[i].inertia * (vec(bodies_[i]->getAngularVelocity()) - before[i].w);
    bool hit = false;
    for (const auto& [pair, contact] : world_.contacts()) hit |= note(pair, contact, now, before, run);
    if (hit && now.time > run.frames.back().time + kSameTime) run.frames.push_back(now);
    ++steps_;
  }

  StagedFrame frame() const {
    StagedFrame f;
    f.time = time();
    for (std::size_t i = 0; i < momenta_.size(); ++i) {
      const CastActor& actor = cast_.actors[i];
      BodyState s;
      s.p = vec(bodies_[i]->getWorldTransform().getOrigin());
      s.v = vec(bodies_[i]->getLinearVelocity()) - Vec3(0, 0, 0.5 * step_ * cast_.gravity);
      s.k = actor.actor.mass * momenta_[i];
      s.q = quat(bodies_[i]->getWorldTransform().getRotation()) * actor.solid.file_to_principal;
      f.bodies.push_back(s);
    }
    return f;
  }

  double time() const { return steps_ * step_; }

 private:
  struct Turning {
    Vec3 v, w;      ///< before the step
    Mat3 inertia;   ///< of unit mass, in the world
  };

  void add(const CastActor& actor, int index) {
    const StageState start = flown(actor, actor.impact, cast_.gravity, 0.0);
    shapes_.push_back(shape_of(actor.solid));
    btRigidBody::btRigidBodyConstructionInfo info(actor.actor.mass, nullptr, shapes_.back().get(), bullet(Vec3(actor.actor.mass * actor.actor.inertia)));
    info.m_startWorldTransform = btTransform(bullet(start.q), bullet(start.p));
    add(info, index);
    btRigidBody& body = *bodies_.back();
    body.setLinearVelocity(bullet(Vec3(start.v + Vec3(0, 0, 0.5 * step_ * cast_.gravity))));
    body.setFlags(body.getFlags() & ~BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    momenta_.push_back(start.h);
  }

  void add(const Wall& wall, int index) {
    shapes_.push_back(std::make_unique<btStaticPlaneShape>(bullet(wall.plane.normal), wall.plane.offset));
    shapes_.back()->setMargin(0);
    add(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, shapes_.back().get()), index);
  }

  void add(const btRigidBody::btRigidBodyConstructionInfo& info, int index) {
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setUserIndex(index);
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  /// Gives each body the angular velocity that it has half a step on, with its momentum.
  std::vector<Turning> turn_freely() {
    std::vector<Turning> all;
    for (std::size_t i = 0; i < momenta_.size(); ++i) {
      const Vec3& inertia = cast_.actors[i].actor.inertia;
      const Quat q = quat(bodies_[i]->getWorldTransform().getRotation());
      const Vec3 w = angular_velocity<double>(q, momenta_[i], inertia);
      const Vec3 half = angular_velocity<double>(rotation_by<double>(w * (0.5 * step_)) * q, momenta_[i], inertia);
      bodies_[i]->setAngularVelocity(bullet(half));
      const Mat3 R = q.toRotationMatrix();
      all.push_back({vec(bodies_[i]->getLinearVelocity()), half, R * inertia.asDiagonal() * R.transpose()});
    }
    return all;
  }

  /// True for a new impact.
  bool note(const std::pair<int, int>& pair, const BulletContact& contact, const StagedFrame& now, const std::vector<Turning>& before, StageRun& run) {
    const Vec3 point = contact.point / contact.impulse, normal = contact.normal.normalized();
    double u_before = 0, u_after = 0;
    for (const int i : {pair.first, pair.second}) {
      if (i < 0) continue;
      const auto at = static_cast<std::size_t>(i);
      const double sign = i == pair.first ? 1.0 : -1.0;
      const Vec3 arm = point - now.bodies[at].p;
      u_before += sign * normal.dot(before[at].v + before[at].w.cross(arm));
      u_after += sign * normal.dot(vec(bodies_[at]->getLinearVelocity()) + vec(bodies_[at]->getAngularVelocity()).cross(arm));
    }
    const bool again = last_.contains(pair) && now.time - last_[pair].time < kSameImpact;
    Last& last = last_[pair];
    last.time = now.time;
    if (again && (last.impact < 0 || contact.impulse <= last.impulse)) return false;
    if (-u_before < kSlowestImpact) {
      if (!again) last.impact = -1;
      return false;
    }
    StagedImpact impact;
    impact.time = std::max(0.0, now.time - contact.depth / -u_before);
    impact.between = {pair.first, pair.second};
    impact.restitution = -u_after / u_before;
    impact.expected = world_.material(pair.first, pair.second).first;
    impact.approach = -u_before;
    impact.contact_point = point;
    impact.normal = normal;
    last.impulse = contact.impulse;
    if (again) {
      StagedImpact& first = run.impacts[static_cast<std::size_t>(last.impact)];
      impact.time = first.time;
      first = impact;
      return false;
    }
    last.impact = static_cast<int>(run.impacts.size());
    run.impacts.push_back(impact);
    return true;
  }

  /// A pair's last contact, and the impact that it belongs to.
  struct Last {
    double time = 0, impulse = 0;
    int impact = -1;
  };

  const Cast& cast_;
  double step_;
  long steps_ = 0;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  BulletWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<Vec3> momenta_;  ///< angular, of unit mass
  std::map<std::pair<int, int>, Last> last_;
};

}  // namespace

StageRun simulate(const Cast& cast, double fps, double duration, const Context& context) {
  const int steps = std::max(1, static_cast<int>(std::ceil(1.0 / (fps * kLongestStep) - 1e-9)));
  const int frames = static_cast<int>(std::floor(duration * fps + 1e-9));
  Simulation simulation(cast, 1.0 / (fps * steps));
  StageRun run;
  run.frames.push_back(simulation.frame());
  for (int f = 1; f <= frames; ++f) {
    context.progress(static_cast<double>(f) / frames);
    for (int i = 0; i < steps; ++i) simulation.advance(run);
    run.frames.push_back(simulation.frame());
  }
  std::stable_sort(run.impacts.begin(), run.impacts.end(), [](const StagedImpact& a, const StagedImpact& b) { return a.time < b.time; });
  return run;
}

}  // namespace unseen::collision
