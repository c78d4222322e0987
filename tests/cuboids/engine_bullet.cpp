// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cuboids/engines.h"

namespace unseen::test {
namespace {

constexpr double kScale = 10.0, kStep = 1.0 / 480.0, kMargin = 0.005;

btVector3 bullet(const Vec3& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }
Vec3 vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform bullet(const Mat3& rotation, const Vec3& translation) {
  const Mat3& m = rotation;
  return btTransform(btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
                     bullet(translation));
}

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld dynamics{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  World() {
    dynamics.setGravity({0, 0, btScalar(-9.81 * kScale)});
    dynamics.getSolverInfo().m_numIterations = 100;
  }
  ~World() {
    for (const auto& body : bodies) dynamics.removeRigidBody(body.get());
  }

  btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape) {
    shapes.push_back(std::move(shape));
    return shapes.back().get();
  }
  btCollisionShape* box(const RigidBox& b) {
    auto shape = std::make_unique<btBoxShape>(bullet(kScale * b.box.half_size));
    shape->setMargin(kMargin);
    return keep(std::move(shape));
  }
  btRigidBody* add(double mass, btCollisionShape* shape, const btTransform& pose, double friction) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
    info.m_startWorldTransform = pose;
    info.m_friction = std::sqrt(friction);  // the engine multiplies those of both bodies
    bodies.push_back(std::make_unique<btRigidBody>(info));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    dynamics.addRigidBody(bodies.back().get());
    return bodies.back().get();
  }
};

/// A rigid body of several boxes; its frame is that of its principal axes of inertia. Returns that frame too.
std::pair<btCollisionShape*, btTransform> compound(World& world, const RigidScene& scene, const std::vector<int>& bodies,
                                                   int body, double& mass) {
  btCompoundShape whole;
  std::vector<btScalar> masses;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] != body) continue;
    const OrientedBox& box = scene.boxes[i].box;
    whole.addChildShape(bullet(box.axes, kScale * box.center), world.box(scene.boxes[i]));
    masses.push_back(scene.boxes[i].density * box.volume());
    mass += masses.back();
  }
  btTransform principal;
  btVector3 inertia;
  whole.calculatePrincipalAxisTransform(masses.data(), principal, inertia);
  auto centred = std::make_unique<btCompoundShape>();
  for (int i = 0; i < whole.getNumChildShapes(); ++i)
    centred->addChildShape(principal.inverse() * whole.getChildTransform(i), whole.getChildShape(i));
  return {world.keep(std::move(centred)), principal};
}

}  // namespace

Settled settle_bullet(const RigidScene& scene, double seconds) {
  const std::vector<int> bodies = rigid_bodies(scene);
  World world;
  for (const Plane& p : scene.planes) {
    auto shape = std::make_unique<btStaticPlaneShape>(bullet(p.normal), kScale * p.offset);
    world.add(0.0, world.keep(std::move(shape)), btTransform::getIdentity(), scene.friction);
  }
  std::vector<btRigidBody*> of_box(bodies.size(), nullptr);
  std::vector<btTransform> start(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const OrientedBox& box = scene.boxes[i].box;
    const auto same = std::find(bodies.begin(), bodies.begin() + i, bodies[i]) - bodies.begin();
    if (bodies[i] < 0) {
      world.add(0.0, world.box(scene.boxes[i]), bullet(box.axes, kScale * box.center), scene.friction);
    } else if (same < static_cast<std::ptrdiff_t>(i)) {
      of_box[i] = of_box[same];
      start[i] = start[same];
    } else if (std::count(bodies.begin(), bodies.end(), bodies[i]) == 1) {
      start[i] = bullet(box.axes, kScale * box.center);
      of_box[i] = world.add(scene.boxes[i].density * box.volume(), world.box(scene.boxes[i]), start[i], scene.friction);
    } else {
      double mass = 0.0;
      const auto [shape, frame] = compound(world, scene, bodies, bodies[i], mass);
      start[i] = frame;
      of_box[i] = world.add(mass, shape, frame, scene.friction);
    }
  }
  const int steps = static_cast<int>(std::lround(seconds / kStep));
  for (int i = 0; i < steps; ++i) world.dynamics.stepSimulation(kStep, 0);
  std::vector<RigidTransform> poses;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RigidTransform pose;
    if (of_box[i]) {
      const btTransform moved = of_box[i]->getWorldTransform() * start[i].inverse();
      for (int r = 0; r < 3; ++r) pose.rotation.row(r) = vector(moved.getBasis()[r]).transpose();
      pose.translation = vector(moved.getOrigin()) / kScale;
    }
    poses.push_back(pose);
  }
  return settled_from(scene, std::move(poses));
}

}  // namespace unseen::test
