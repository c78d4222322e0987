// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/stacks.h"

#include <algorithm>
#include <cmath>

#include "cuboids/statics/interface.h"
#include "unseen/core/random.h"

namespace unseen::test {
namespace {

using cuboids::Balance;
using cuboids::Body;
using cuboids::ContactPoint;
using cuboids::ConvexSolid;

constexpr double kStable = 1e-6;

Mat3 yaw(double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(); }

RigidBox box_at(const Vec3& bottom, const Vec3& size, double angle, double density) {
  return {{bottom + 0.5 * size.z() * Vec3::UnitZ(), yaw(angle), 0.5 * size}, density, -1, false};
}

Vec3 random_size(Random& random) {
  return {random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), random.uniform(0.05, 0.2)};
}

double random_density(Random& random) { return random.uniform(150.0, 900.0); }

/// Each box lies off the middle of the one below.
void tower(Random& random, std::vector<RigidBox>& boxes) {
  const std::size_t count = 2 + random.index(5);
  const double reach = random.uniform(0.2, 0.75);
  Vec3 bottom = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 size = random_size(random);
    boxes.push_back(box_at(bottom, size, random.uniform(-0.6, 0.6), random_density(random)));
    const double angle = random.uniform(0.0, 2.0 * kPi);
    bottom += Vec3(reach * size.x() * std::cos(angle), reach * size.y() * std::sin(angle), 0.0) * random.uniform();
    bottom.z() += size.z();
  }
}

/// Rows of boxes of equal height in an odd bond, with gaps.
void pile(Random& random, std::vector<RigidBox>& boxes) {
  const std::size_t rows = 2 + random.index(3);
  const double length = random.uniform(0.15, 0.25), height = random.uniform(0.06, 0.15);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i + row < rows + 1; ++i) {
      if (row > 0 && random.uniform() < 0.15) continue;
      const double x = (static_cast<double>(i) + 0.5 * static_cast<double>(row)) * 1.08 * length;
      const Vec3 bottom(x + random.uniform(-0.02, 0.02) * length, random.uniform(-0.02, 0.02),
                        height * static_cast<double>(row));
      if (row > 0) {
        const auto carries = [&](const RigidBox& b) {
          return std::abs(b.box.center.z() + 0.5 * height - bottom.z()) < 1e-9 &&
                 std::abs(b.box.center.x() - x) < 0.9 * length;
        };
        if (std::none_of(boxes.begin(), boxes.end(), carries)) continue;
      }
      boxes.push_back(box_at(bottom, {length, 0.12, height}, 0.0, random_density(random)));
    }
}

/// Two pillars, a plank across, a load somewhere on it.
void bridge(Random& random, std::vector<RigidBox>& boxes) {
  const double height = random.uniform(0.1, 0.3), span = random.uniform(0.2, 0.5), wide = random.uniform(0.08, 0.15);
  for (const double x : {0.0, span})
    boxes.push_back(box_at({x, 0, 0}, {wide, 0.15, height}, 0.0, random_density(random)));
  const double length = random.uniform(0.5, 1.3) * (span + wide);
  boxes.push_back(box_at({random.uniform(0.2, 0.8) * span, 0, height}, {length, 0.12, 0.03}, random.uniform(-0.05, 0.05),
                         random_density(random)));
  const OrientedBox plank = boxes.back().box;
  const double along = random.uniform(-0.45, 0.45) * length;
  boxes.push_back(box_at(plank.center + along * plank.axes.col(0) + Vec3(0, 0, 0.015), random_size(random) * 0.7,
                         random.uniform(-0.5, 0.5), random_density(random)));
}

/// A plank far over the edge of a pillar, held down at its other end or not.
void counterweight(Random& random, std::vector<RigidBox>& boxes) {
  const double height = random.uniform(0.1, 0.4), length = random.uniform(0.3, 0.7);
  const double wide = random.uniform(0.15, 0.25), over = random.uniform(0.1, 0.45) * length;
  boxes.push_back(box_at({0, 0, 0}, {wide, 0.2, height}, 0.0, random_density(random)));
  boxes.push_back(box_at({over, 0, height}, {length, 0.1, 0.03}, 0.0, random_density(random)));
  const double back = over - 0.5 * length;
  boxes.push_back(box_at({back + random.uniform(0.05, 0.12), 0, height + 0.03}, {0.1, 0.1, random.uniform(0.04, 0.25)},
                         random.uniform(-0.4, 0.4), random_density(random)));
}

/// A plank with one edge on the ground against the upper edge of a block.
void leaning(Random& random, std::vector<RigidBox>& boxes) {
  const double height = random.uniform(0.15, 0.4), angle = radians(random.uniform(25.0, 75.0));
  const double length = height / std::sin(angle) * random.uniform(1.05, 1.9), thick = 0.03;
  boxes.push_back(box_at({0.1, 0, 0}, {0.2, 0.3, height}, 0.0, random_density(random)));
  const Vec3 along(std::cos(angle), 0.0, std::sin(angle)), out(-std::sin(angle), 0.0, std::cos(angle));
  const Vec3 foot(-height / std::tan(angle), 0.0, 0.0);
  OrientedBox plank;
  plank.axes << along, Vec3::UnitY(), along.cross(Vec3::UnitY());
  plank.half_size = 0.5 * Vec3(length, 0.12, thick);
  plank.center = foot + 0.5 * length * along + 0.5 * thick * out;
  boxes.push_back({plank, random_density(random), -1, false});
}

}  // namespace

Stack random_stack(std::uint64_t seed) {
  static constexpr struct {
    const char* name;
    void (*build)(Random&, std::vector<RigidBox>&);
  } kKinds[] = {{"tower", tower}, {"pile", pile}, {"bridge", bridge}, {"counterweight", counterweight},
                {"leaning", leaning}};
  Random random(seed);
  const auto& kind = kKinds[seed % std::size(kKinds)];
  Stack stack{kind.name, {}};
  kind.build(random, stack.scene.boxes);
  stack.scene.friction = random.uniform(0.3, 0.9);
  return stack;
}

Statics statics_of(const RigidScene& scene, double tolerance) {
  const std::vector<int> rigid = rigid_bodies(scene);
  std::vector<Body> bodies = {{0.0, Vec3::Zero(), 0.0, true}};
  std::vector<int> group = {0};
  std::vector<ConvexSolid> solids;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const OrientedBox& box = scene.boxes[i].box;
    bodies.push_back({9.81 * scene.boxes[i].density * box.volume(), box.center, box.half_size.norm(), rigid[i] < 0});
    group.push_back(rigid[i] + 1);
    solids.push_back(cuboids::solid_of(box));
  }
  Statics statics{cuboids::merge(bodies, group, *std::max_element(group.begin(), group.end()) + 1), {}};
  const auto add = [&](int a, int b, const std::optional<cuboids::Interface>& met) {
    if (!met || a == b) return;
    for (const Vec3& p : met->points) statics.contacts.push_back({a, b, p, met->normal, scene.friction});
  };
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (const Plane& plane : scene.planes)
      add(0, group[i + 1], cuboids::interface_of(cuboids::Support{0, {}, plane, {}}, solids[i], tolerance));
    for (std::size_t k = i + 1; k < solids.size(); ++k)
      add(group[i + 1], group[k + 1], cuboids::interface_of(solids[i], solids[k], tolerance));
  }
  return statics;
}

Verdict decide(const RigidScene& scene) {
  Statics statics = statics_of(scene);
  Verdict verdict;
  verdict.residual = cuboids::balance(statics.bodies, statics.contacts).residual;
  verdict.stands = verdict.residual < kStable;
  verdict.margin = cuboids::margin(statics.bodies, statics.contacts, kStable);
  for (ContactPoint& c : statics.contacts) c.friction *= verdict.stands ? 0.9 : 1.1;
  if (verdict.stands) {
    verdict.is_clear = verdict.margin >= 0.1 && cuboids::balance(statics.bodies, statics.contacts).residual < kStable;
    return verdict;
  }
  verdict.is_clear = true;
  for (int k = 0; k < 16; ++k) {
    const Vec3 push(0.1 * std::cos(k * kPi / 8.0), 0.1 * std::sin(k * kPi / 8.0), -1.0);
    verdict.is_clear &= cuboids::balance(statics.bodies, statics.contacts, push).residual > kStable;
  }
  return verdict;
}

}  // namespace unseen::test
