// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <map>
#include <set>

#include "collision/stage/stage_cast.h"

namespace unseen::collision {

inline btVector3 bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion bullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Vec3 vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline Quat quat(const btQuaternion& q) { return Quat(q.w(), q.x(), q.y(), q.z()); }

/// What a pair had from one step's solution.
struct BulletContact {
  double depth = 0, impulse = 0;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
};

/// Bullet's world, in which only what overlaps touches (Bullet takes contacts ahead of time, and they rob it of its bounce), each pair has
/// its own restitution and friction, and who touches whom is written down.
class BulletWorld : public btDiscreteDynamicsWorld {
 public:
  BulletWorld(const Cast& cast, btDispatcher* dispatcher, btBroadphaseInterface* pairs, btConstraintSolver* solver, btCollisionConfiguration* configuration)
      : btDiscreteDynamicsWorld(dispatcher, pairs, solver, configuration), cast_(cast) {
    for (const CastPair& pair : cast.pairs) own_[key(pair.a, pair.b)] = &pair;
    btContactSolverInfo& info = getSolverInfo();
    info.m_splitImpulse = 1;
    info.m_splitImpulsePenetrationThreshold = 0;
    info.m_restitutionVelocityThreshold = kAtRest;
    info.m_linearSlop = 0;
    info.m_numIterations = 100;
    info.m_warmstartingFactor = 0;  // warm starting stays on, for it is what writes the impulses back
    info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
  }

  /// Restitution and friction between two.
  std::pair<double, double> material(int a, int b) const {
    if (const auto found = own_.find(key(a, b)); found != own_.end()) return {found->second->restitution, found->second->friction};
    const Actor& one = cast_.actors[static_cast<std::size_t>(a)].actor;
    const Actor& other = b >= 0 ? cast_.actors[static_cast<std::size_t>(b)].actor : one;  // the floor gives back what the body does
    return {one.restitution * other.restitution, one.friction * other.friction};
  }

  /// Of the last step.
  const std::map<std::pair<int, int>, BulletContact>& contacts() const { return contacts_; }

 protected:
  void solveConstraints(btContactSolverInfo& info) override {
    contacts_.clear();
    for (int m = 0; m < getDispatcher()->getNumManifolds(); ++m) prepare(*getDispatcher()->getManifoldByIndexInternal(m));
    btDiscreteDynamicsWorld::solveConstraints(info);
    for (int m = 0; m < getDispatcher()->getNumManifolds(); ++m) note(*getDispatcher()->getManifoldByIndexInternal(m));
  }

 private:
  static constexpr double kAtRest = 0.02;  // m/s: slower contacts do not bounce

  static std::pair<int, int> key(int a, int b) { return {std::max(a, b), std::min(a, b)}; }  // actors count from 0, walls down from −1
  static std::pair<int, int> key(const btPersistentManifold& m) { return key(m.getBody0()->getUserIndex(), m.getBody1()->getUserIndex()); }

  bool may_touch(const std::pair<int, int>& pair) const {
    if (pair.second >= 0) return true;
    const int owner = cast_.walls[static_cast<std::size_t>(-1 - pair.second)].collision;
    return owner < 0 || owner == cast_.actors[static_cast<std::size_t>(pair.first)].collision;
  }

  void prepare(btPersistentManifold& m) const {
    const auto pair = key(m);
    const auto [restitution, friction] = material(pair.first, pair.second);
    for (int i = m.getNumContacts() - 1; i >= 0; --i) {
      btManifoldPoint& p = m.getContactPoint(i);
      if (p.getDistance() > 0 || !may_touch(pair)) {
        m.removeContactPoint(i);
        continue;
      }
      p.m_combinedRestitution = restitution;
      p.m_combinedFriction = friction;
      p.m_appliedImpulse = 0;
      direct_friction(p, pair);
    }
  }

  /// At the impact that was reconstructed friction acts along the impulse that was estimated: where the sliding turns during an impact,
  /// Coulomb's law at the end of a step, which is Bullet's, says another direction than at its beginning.
  void direct_friction(btManifoldPoint& p, const std::pair<int, int>& pair) const {
    p.m_contactPointFlags &= ~BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    const auto found = own_.find(pair);
    if (found == own_.end() || touched_.contains(pair)) return;
    const Vec3 normal = vec(p.m_normalWorldOnB), across = found->second->rub - normal.dot(found->second->rub) * normal;
    if (!(across.norm() > 1e-9)) return;
    p.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    p.m_lateralFrictionDir1 = bullet(Vec3(across.normalized()));
    p.m_lateralFrictionDir2.setZero();
  }

  void note(const btPersistentManifold& m) {
    const double sign = m.getBody0()->getUserIndex() == key(m).first ? 1.0 : -1.0;
    for (int i = 0; i < m.getNumContacts(); ++i) {
      const btManifoldPoint& p = m.getContactPoint(i);
      if (!(p.m_appliedImpulse > 0)) continue;
      touched_.insert(key(m));
      BulletContact& c = contacts_[key(m)];
      c.impulse += p.m_appliedImpulse;
      c.point += p.m_appliedImpulse * 0.5 * vec(p.getPositionWorldOnA() + p.getPositionWorldOnB());
      c.normal += sign * p.m_appliedImpulse * vec(p.m_normalWorldOnB);
      c.depth = std::max(c.depth, -p.getDistance());
    }
  }

  const Cast& cast_;
  std::map<std::pair<int, int>, const CastPair*> own_;
  std::map<std::pair<int, int>, BulletContact> contacts_;
  std::set<std::pair<int, int>> touched_;  ///< so far
};

}  // namespace unseen::collision
