// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Relations that show only once surfaces are fitted to their points.
#include <gtest/gtest.h>

#include "planes/arrange.h"
#include "planes/scenes.h"
#include "unseen/planes/evaluate.h"

namespace unseen::planes {
namespace {

/// A room, and a roof whose ridge is off the room's x axis by `off`; its fit is known to `sigma` (deg).
Model room_and_roof(double off, double sigma) {
  Model m;
  m.locals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const Vec3 roof = Vec3(std::sin(radians(off)), 0.5, std::sqrt(0.75)).normalized();
  m.frames = {{Mat3::Identity(), true}, open_frame(roof, {})};
  const auto add = [&](int frame, int local, const Vec3& normal, double area) {
    Surface& s = m.surfaces.emplace_back(Surface{frame, local, {}, 0.0});
    s.support.fit.normal = normal;
    s.support.fit.u = any_orthogonal(normal);
    s.support.fit.v = normal.cross(s.support.fit.u);
    s.support.variance_u = s.support.variance_v = std::pow(radians(sigma), 2);
    s.support.area = area;
    s.support.moments = {100, normal, Mat3::Identity()};
  };
  for (int l = 0; l < 3; ++l) add(0, l, Vec3::Unit(l), 10.0);
  add(1, 0, roof, 5.0);
  return m;
}

bool related(Model& m) { return relate_again(m, make_angles({kPi / 2}), {}); }

TEST(RelateAgain, ARoofGetsTheRidgeThatItsFitSuggests) {
  Model m = room_and_roof(0.05, 0.05);
  ASSERT_TRUE(related(m));
  ASSERT_EQ(m.constraints.size(), 1u);
  refit(m);
  EXPECT_NEAR(m.normal(m.surfaces[3]).dot(m.normal(m.surfaces[0])), 0.0, 1e-12);
  EXPECT_FALSE(related(m)) << "all that holds is stated";
}

TEST(RelateAgain, NotWhatDiffersSignificantlyNorWhatIsLikelyByChance) {
  Model certain = room_and_roof(0.1, 0.01), vague = room_and_roof(2.0, 1.0), free = room_and_roof(0.05, 0.05);
  free.local_fits = true;
  for (Model* m : {&certain, &vague, &free}) {
    EXPECT_FALSE(related(*m));
    EXPECT_TRUE(m->constraints.empty());
  }
}

TEST(RelateAgain, KeepsTheRelationsThatThereAre) {
  Model m = room_and_roof(0.05, 0.05);
  m.constraints = {{1, 0, Vec3::UnitX(), Vec3::UnitX(), 0.0}};
  m.frames[1] = open_frame(Vec3(0, 0.5, std::sqrt(0.75)), {});
  EXPECT_FALSE(related(m));
  EXPECT_EQ(m.constraints.size(), 1u);
}

/// Houses whose roofs have their ridges along the walls: hardly more pairs are nearly related than directions drawn at random would be.
TEST(RelateAgain, NearMissesOfABuildingAreThoseOfChance) {
  constexpr double kHardlyMore = 1.5;
  const auto file = test::shared_scan("cgal/building.ply");
  if (file.empty()) GTEST_SKIP() << test::kNoScan;
  const auto source = io::open_points(file);
  Options options;
  options.scale = 0.3;
  Context context;
  const test::Run r = test::run(*source, options, context);
  const std::size_t n = r.result.planes.size();
  EXPECT_LT(static_cast<double>(evaluate_relations(r.result).near_misses), kHardlyMore * std::sin(radians(1.0)) * static_cast<double>(n * (n - 1) / 2));
}

}  // namespace
}  // namespace unseen::planes
