// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/synth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cuboids/synth/synth_sensor.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::cuboids {
namespace {

SynthView view_of(const std::string& family, int boxes = 0, int view = 0) {
  SynthOptions options;
  options.scene = family;
  options.boxes = boxes;
  options.view = view;
  Context context;
  return make_scene(options, context).views.front();
}

/// m, outside a box; negative inside: to the nearest face.
double distance_to(const OrientedBox& box, const Vec3& p) {
  const Vec3 beyond = (box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size;
  const double outside = beyond.cwiseMax(0.0).norm();
  return outside > 0 ? outside : beyond.maxCoeff();
}

/// A point of a box's surface, corners and edges included now and then.
Vec3 surface_point(const OrientedBox& box, Random& random) {
  Vec3 at;
  for (int k = 0; k < 3; ++k) at[k] = random.uniform() < 0.2 ? (random.uniform() < 0.5 ? -1.0 : 1.0) : random.uniform(-1, 1);
  const std::size_t k = random.index(3);
  at[static_cast<Eigen::Index>(k)] = random.uniform() < 0.5 ? -1.0 : 1.0;
  return box.center + box.axes * at.cwiseProduct(box.half_size);
}

/// The least distance from any of many points of either surface to the other box, by pattern search from the best.
double brute_distance(const OrientedBox& a, const OrientedBox& b, Random& random) {
  double least = 1e9;
  for (const auto& [from, to] : {std::pair{&a, &b}, {&b, &a}}) {
    Vec3 best = from->center;
    double found = 1e9;
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = surface_point(*from, random);
      const double distance = distance_to(*to, p);
      if (distance < found) {
        found = distance;
        best = p;
      }
    }
    for (double step = 0.05; step > 1e-5; step *= 0.7)
      for (int i = 0; i < 12; ++i) {
        Vec3 at = from->axes.transpose() * (best + step * random.direction() - from->center);
        at = at.cwiseMin(from->half_size).cwiseMax(-from->half_size);
        const Vec3 p = from->center + from->axes * at;
        if (distance_to(*to, p) < found) {
          found = distance_to(*to, p);
          best = p;
        }
      }
    least = std::min(least, found);
  }
  return least;
}

class SynthFamilies : public testing::TestWithParam<std::string> {};

TEST_P(SynthFamilies, ContactsAreThoseThatSamplingFinds) {
  const Truth truth = view_of(GetParam()).truth;
  std::set<std::pair<int, int>> listed;
  for (const Contact& contact : truth.contacts) EXPECT_TRUE(listed.insert({contact.a, contact.b}).second);
  Random random(5);
  for (std::size_t i = 0; i < truth.cuboids.size(); ++i) {
    const OrientedBox& a = *truth.cuboids[i].box;
    for (const Support& support : truth.supports) {
      double least = 1e9;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        least = std::min(least, support.plane.signed_distance(a.center + a.axes * side.cwiseProduct(a.half_size)));
      }
      EXPECT_GT(least, -1e-9);
      EXPECT_EQ(listed.count({support.id, truth.cuboids[i].id}), least < 1e-6 ? 1u : 0u);
    }
    for (std::size_t j = i + 1; j < truth.cuboids.size(); ++j) {
      const OrientedBox& b = *truth.cuboids[j].box;
      const bool contact = listed.count({truth.cuboids[i].id, truth.cuboids[j].id}) > 0;
      if ((a.center - b.center).norm() > a.half_size.norm() + b.half_size.norm() + 0.01) {
        EXPECT_FALSE(contact);
        continue;
      }
      const double distance = brute_distance(a, b, random);
      EXPECT_GT(distance, -1e-6) << i << " " << j;  // nothing penetrates
      if (contact)
        EXPECT_LT(distance, 1e-3) << i << " " << j;
      else
        EXPECT_GT(distance, 0.02) << i << " " << j;  // no near misses that a sensor could not tell
    }
  }
}

TEST_P(SynthFamilies, DepthIsTheDistanceToTheTrueBoxes) {
  const SynthView view = view_of(GetParam());
  Random random(11);
  const Truth& truth = view.truth;
  for (int i = 0; i < 300; ++i) {
    const int u = static_cast<int>(random.index(640)), v = static_cast<int>(random.index(480));
    const std::size_t pixel = static_cast<std::size_t>(v) * 640 + u;
    const double depth = view.exact_depth[pixel];
    if (depth == 0.0) continue;
    const Vec3 p = truth.T_world_camera * Vec3((u - 319.5) / 525 * depth, (v - 239.5) / 525 * depth, depth);
    if (view.masks[pixel] > 0) {
      EXPECT_NEAR(distance_to(*truth.cuboids[view.masks[pixel] - 1].box, p), 0.0, 1e-6);
    } else {
      double least = 1e9;
      for (const Support& support : truth.supports) least = std::min(least, std::abs(support.plane.signed_distance(p)));
      EXPECT_NEAR(least, 0.0, 1e-6);
    }
    // Nothing stands in the way.
    for (const TrueCuboid& cuboid : truth.cuboids)
      for (double t = 0.01; t < 0.995; t += 0.01)
        ASSERT_GT(distance_to(*cuboid.box, truth.T_world_camera.translation + t * (p - truth.T_world_camera.translation)), -1e-6);
  }
}

TEST_P(SynthFamilies, TheWorldIsThatOfAResult) {
  const SynthView view = view_of(GetParam());
  const RigidTransform& T = view.truth.T_world_camera;
  EXPECT_TRUE(T.is_rigid(1e-9));
  EXPECT_NEAR(T.translation.x(), 0.0, 1e-9);
  EXPECT_NEAR(T.translation.y(), 0.0, 1e-9);
  EXPECT_NEAR(T.rotation(0, 2), 0.0, 1e-9);  // forward is towards +y
  EXPECT_GT(T.rotation(1, 2), 0.0);
  EXPECT_LT(T.rotation(2, 2), 0.0);  // and down
  EXPECT_LT((view.truth.supports[0].plane.normal - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(view.truth.supports[0].plane.offset, 0.0, 1e-9);
  std::set<int> ids;
  for (const Support& support : view.truth.supports) EXPECT_TRUE(ids.insert(support.id).second);
  for (const TrueCuboid& cuboid : view.truth.cuboids) EXPECT_TRUE(ids.insert(cuboid.id).second);
}

INSTANTIATE_TEST_SUITE_P(All, SynthFamilies, testing::ValuesIn(synth_families()), [](const auto& family) {
  std::string name = family.param;
  std::erase(name, '-');
  return name;
});

TEST(SynthCuboids, HowManyBoxesAndFixedContacts) {
  const auto fixed = [](const Truth& truth) {
    return std::count_if(truth.contacts.begin(), truth.contacts.end(), [](const Contact& c) { return c.kind == ContactKind::fixed; });
  };
  EXPECT_EQ(fixed(view_of("chair-1").truth), 1);
  EXPECT_EQ(fixed(view_of("chair-2").truth), 5);
  EXPECT_EQ(fixed(view_of("shelf").truth), 2);
  EXPECT_EQ(fixed(view_of("tower").truth), 0);
  // Courses of two, three, three and seven: neighbours, those below (the first of a course has one, or two), ground.
  for (const auto& [boxes, contacts] : {std::pair{6u, 11u}, {9u, 19u}, {18u, 40u}, {56u, 146u}}) {
    const Truth truth = view_of("running-bond", static_cast<int>(boxes)).truth;
    EXPECT_EQ(truth.cuboids.size(), boxes);
    EXPECT_EQ(truth.contacts.size(), contacts);
  }
}

TEST(SynthCuboids, NoiseHasTheSizeThatWasAskedFor) {
  const std::vector<float> exact(640 * 480, 2.0f);
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  for (const double depth : {1.0, 1.7, 2.9}) {
    Random random(2);
    const auto measured = measure(std::vector<float>(640 * 480, static_cast<float>(depth)), camera, 0.0015, 0.6, random);
    double sum = 0;
    std::set<float> levels;
    for (const float d : measured) {
      sum += (d - depth) * (d - depth);
      levels.insert(d);
    }
    const double sigma = std::sqrt(sum / static_cast<double>(measured.size()));
    EXPECT_NEAR(sigma, 0.0015 * depth * depth, 0.15 * 0.0015 * depth * depth) << depth;
    EXPECT_LT(levels.size(), 10u);  // steps of the disparity
  }
}

TEST(SynthCuboids, EdgesDropOutAndFacesStay) {
  const SynthView view = view_of("tower");
  std::size_t edge = 0, edge_lost = 0, inner = 0, inner_lost = 0;
  for (int v = 3; v < 477; ++v)
    for (int u = 3; u < 637; ++u) {
      const auto at = [&](int du, int dv) { return static_cast<double>(view.exact_depth[(v + dv) * 640 + u + du]); };
      if (at(0, 0) == 0.0) continue;
      double jump = 0;
      for (int dv = -3; dv <= 3; ++dv)
        for (int du = -3; du <= 3; ++du) jump = std::max(jump, std::abs(at(du, dv) - at(0, 0)));
      const bool lost = view.depth[v * 640 + u] == 0.0f;
      if (jump < 0.005) ++inner, inner_lost += lost;
      if (std::max(std::abs(at(1, 0) - at(0, 0)), std::abs(at(0, 1) - at(0, 0))) > 0.1) ++edge, edge_lost += lost;
    }
  EXPECT_EQ(inner_lost, 0u);
  EXPECT_GT(inner, 10000u);
  EXPECT_NEAR(static_cast<double>(edge_lost) / static_cast<double>(edge), 0.6, 0.1);
}

TEST(SynthCuboids, HiddenSharesFollowTheView) {
  const Truth truth = view_of("shelf").truth;
  for (const TrueCuboid& cuboid : truth.cuboids) {
    for (int f = 0; f < 6; ++f) {
      const Vec3 normal = (f % 2 == 0 ? -1 : 1) * cuboid.box->axes.col(f / 2);
      const Vec3 at = cuboid.box->center + cuboid.box->half_size[f / 2] * normal;
      if (normal.dot(truth.T_world_camera.translation - at) < 0) {
        EXPECT_EQ(cuboid.hidden[f], 1.0);
      }
      EXPECT_GE(cuboid.hidden[f], 0.0);
    }
    EXPECT_EQ(cuboid.hidden[4], 1.0);  // nothing is seen from below
    EXPECT_GE(cuboid.seen.minCoeff(), 0.0);
    EXPECT_LE(cuboid.seen.maxCoeff(), 1.0 + 1e-9);
  }
  // The chest: top and front in view, but for what stands on it.
  EXPECT_LT(truth.cuboids[7].hidden[5], 0.4);
  EXPECT_LT(truth.cuboids[7].hidden[2], 0.1);
}

TEST(SynthCuboids, SameBytesAtAnyThreadCount) {
  SynthOptions options;
  options.scene = "twisted";
  options.view = 1;
  Context one, four;
  one.threads = 1;
  four.threads = 4;
  const SynthView a = make_scene(options, one).views[0], b = make_scene(options, four).views[0];
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.color, b.color);
  options.seed = 2;
  EXPECT_NE(make_scene(options, one).views[0].depth, a.depth);
}

TEST(SynthCuboids, RemovedBoxesLeaveTheRestWhereItWas) {
  SynthOptions options;
  options.scene = "tower";
  options.view = 0;
  Context context;
  const Truth all = make_scene(options, context).views[0].truth;
  options.removed = 2;
  const Truth rest = make_scene(options, context).views[0].truth;
  ASSERT_EQ(rest.cuboids.size() + 2, all.cuboids.size());
  EXPECT_EQ(rest.T_world_camera.translation, all.T_world_camera.translation);
  for (std::size_t i = 0; i < rest.cuboids.size(); ++i) EXPECT_EQ(rest.cuboids[i].box->center, all.cuboids[i].box->center);
  EXPECT_LT(rest.cuboids.back().hidden[5], all.cuboids[rest.cuboids.size() - 1].hidden[5]);
}

TEST(SynthCuboids, BadOptionsAreRefused) {
  Context context;
  const auto make = [&](auto change) {
    SynthOptions options;
    change(options);
    make_scene(options, context);
  };
  EXPECT_THROW(make([](SynthOptions& o) { o.scene = "castle"; }), InputError);
  EXPECT_THROW(make([](SynthOptions& o) { o.boxes = 30; }), InputError);
  EXPECT_THROW(make([](SynthOptions& o) { o.scene = "desk", o.boxes = 3; }), InputError);
  EXPECT_THROW(make([](SynthOptions& o) { o.scene = "bridge", o.removed = 2; }), InputError);
  EXPECT_THROW(make([](SynthOptions& o) { o.removed = 6; }), InputError);
  EXPECT_THROW(make([](SynthOptions& o) { o.noise = -1; }), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
