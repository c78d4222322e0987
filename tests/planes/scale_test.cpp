// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The estimated scale: spacing and noise of the surfaces, whatever else a scan holds.
#include <gtest/gtest.h>

#include "planes/scan/scale.h"
#include "planes/scenes.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

double extent_of(const PointCloud& cloud) {
  CloudSource source(cloud);
  Context context;
  return survey(source, context).extent();
}

double scale_of(const PointCloud& cloud, const Options& options = {}) {
  CloudSource source(cloud);
  Context context;
  const Survey s = survey(source, context);
  return choose_scale(source, s, space_of(s, false), options, context).scale;
}

TEST(ChooseScale, FollowsTheSpacing) {
  for (const double spacing : {0.01, 0.02, 0.04}) {
    // The sixth neighbour of a grid of one point per spacing² lies at about √(6/π) spacings.
    const double expected = 1.25 * std::sqrt(6 / kPi) * spacing;
    const double scale = scale_of(test::plane_cloud(spacing, 0.0));
    EXPECT_GT(scale, 0.8 * expected);
    EXPECT_LT(scale, 1.2 * expected);
  }
}

TEST(ChooseScale, FollowsTheNoiseWhereThatIsLarger) {
  const double scale = scale_of(test::plane_cloud(0.02, 0.015));
  EXPECT_GT(scale, 2.0 * 0.015);
  EXPECT_LT(scale, 5.0 * 0.015);
}

/// Thinning to a sample must not coarsen the estimate.
TEST(ChooseScale, IsThatOfTheWholeCloud) {
  const PointCloud cloud = test::plane_cloud(0.0023, 0.0);  // 600 000 points, twice what a sample holds
  const double expected = 1.25 * std::sqrt(6 / kPi) * 0.0023;
  EXPECT_NEAR(scale_of(cloud), expected, 0.2 * expected);
}

/// A scanner on a car: lines 10 cm apart with a point a centimetre. The nearest neighbours are all in one line, and tell nothing of a surface.
TEST(ChooseScale, ReachesTheNextLineOfAScan) {
  PointCloud cloud;
  Random random(3);
  for (int line = 0; line < 40; ++line)
    for (int i = 0; i < 400; ++i) cloud.positions.emplace_back(0.1 * line, 0.01 * (i + random.uniform()), 0.002 * random.normal());
  const double scale = scale_of(cloud);
  EXPECT_GT(scale, 0.1);
  EXPECT_LT(scale, 0.2);
}

/// The two sides of a wall in a plan, 12 cm apart, are no noise of one line.
TEST(ChooseScale, KeepsTheSidesOfADrawnWallApart) {
  for (const double step : {0.01, 0.015}) {
    PointCloud cloud;
    Random random(3);
    for (double x = 0; x < 10; x += step)
      for (const double y : {0.0, 0.12}) cloud.positions.emplace_back(x + step * random.uniform(), y + 0.001 * random.normal(), 0);
    CloudSource source(cloud);
    Context context;
    const Survey s = survey(source, context);
    EXPECT_LT(choose_scale(source, s, space_of(s, true), {}, context).scale, 0.07) << step;
  }
}

TEST(ChooseScale, TakesWhatItIsTold) {
  const PointCloud cloud = test::plane_cloud(0.02, 0.0);
  Options options;
  options.relative_scale = 0.05;
  EXPECT_NEAR(scale_of(cloud, options), 0.05 * extent_of(cloud), 1e-12);
  options.relative_scale.reset();
  options.scale = 0.123;
  EXPECT_EQ(scale_of(cloud, options), 0.123);
  options.scale = 5.0;
  EXPECT_THROW(scale_of(cloud, options), InputError);
}

/// Noise above the spacing: the nearest points alone would show little of it.
TEST(ChooseScale, FollowsNoiseFarAboveTheSpacing) {
  const double scale = scale_of(test::plane_cloud(0.008, 0.02));
  EXPECT_GT(scale, 3.0 * 0.02);
  EXPECT_LT(scale, 5.0 * 0.02);
}

/// Points of a raster are many times just as far from each other.
TEST(ChooseScale, DoesNotDependOnTheOrder) {
  PointCloud cloud;
  for (int x = 0; x < 1000; ++x)
    for (int y = 0; y < 800; ++y)
      cloud.positions.emplace_back(0.01 * x, 0.01 * y, 0.01 * ((x * 7 + y * 3) % 5));
  const double scale = scale_of(cloud);
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  EXPECT_EQ(scale_of(cloud), scale);
  Random random(13);
  for (std::size_t i = cloud.size(); i > 1; --i)
    std::swap(cloud.positions[i - 1], cloud.positions[random.index(i)]);
  EXPECT_EQ(scale_of(cloud), scale);
}

/// As in many frames of a depth camera: thousands of points lie nearer than the noise is thick.
TEST(ChooseScale, FollowsNoiseOfAVeryDenseCloud) {
  const double scale = scale_of(test::plane_cloud(0.0014, 0.015));
  EXPECT_GT(scale, 3.0 * 0.015);
  EXPECT_LT(scale, 5.0 * 0.015);
}

TEST(ChooseScale, StrayPointsDoNotCount) {
  PointCloud cloud = test::plane_cloud(0.02, 0.002);
  const double without = scale_of(cloud);
  Random random(11);
  for (std::size_t i = cloud.size() / 4; i > 0; --i)
    cloud.positions.emplace_back(random.uniform(0, 2), random.uniform(0, 1.6), random.uniform(-1, 1.5));
  EXPECT_NEAR(scale_of(cloud), without, 0.15 * without);
}

/// A house among trees: most points fill space, and lie on no plane.
TEST(ChooseScale, PlantsDoNotCount) {
  PointCloud cloud = test::plane_cloud(0.02, 0.003);
  const double alone = scale_of(cloud), share = 1.5;
  Random random(5);
  for (int i = static_cast<int>(share * static_cast<double>(cloud.size())); i > 0; --i)
    cloud.positions.emplace_back(1.5 + 2.5 * random.uniform(), 2.5 * random.uniform(), 2.5 * random.uniform());
  EXPECT_NEAR(scale_of(cloud), alone, 0.3 * alone);
}

/// The two sides of a wall are one neighbourhood in a thinned sample, but not in the whole cloud.
/// A box amid dust; every point twice says no more than once.
TEST(ChooseScale, WarnsWhereFewPointsLieOnPlanes) {
  PointCloud cloud = test::box_cloud({0, 0, 0}, {2, 1.5, 1}, 0.03, 0.002, 1);
  Random random(3);
  const std::size_t dust = 2 * cloud.size();
  for (std::size_t i = 0; i < dust; ++i) cloud.positions.emplace_back(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
  const auto warned = [](const Arrangement& a) {
    return std::any_of(a.summary.warnings.begin(), a.summary.warnings.end(), [](const std::string& w) { return w.find("of the points lie on planes") != std::string::npos; });
  };
  const Arrangement once = test::run(cloud, Options()).result;
  ASSERT_FALSE(once.planes.empty());
  EXPECT_TRUE(warned(once));
  const std::vector<Vec3> points = cloud.positions;
  cloud.positions.insert(cloud.positions.end(), points.begin(), points.end());
  EXPECT_TRUE(warned(test::run(cloud, Options()).result));
}

TEST(ChooseScale, BothSidesOfAThinWallAreNoNoise) {
  PointCloud cloud;
  Random random(12);
  for (const double y : {0.0, 0.03})
    test::add_rectangle(cloud, {0, y, 0}, {3, 0, 0}, {0, 0, 2}, 0.002, 0.0005, random);
  ASSERT_GT(cloud.size(), 2'000'000u);
  EXPECT_NEAR(scale_of(cloud), 1.25 * std::sqrt(6 / kPi) * 0.002, 0.001);
}

// Sparse but precise points lie nearer to their planes than they are apart; correlated noise, and what is asked for, leave no such room.
TEST(ChooseScale, ToleranceFollowsTheNoise) {
  const auto of = [](const PointCloud& cloud, const Options& options) {
    CloudSource source(cloud);
    Context context;
    const Survey s = survey(source, context);
    const Scale scale = choose_scale(source, s, space_of(s, false), options, context);
    return scale.tolerance / scale.scale;
  };
  const PointCloud precise = test::plane_cloud(0.02, 0.0005);
  PointCloud wavy = test::plane_cloud(0.02, 0.0005);
  for (Vec3& p : wavy.positions) p.z() += 0.014 * std::sin(2 * kPi * p.x() / 0.3) * std::sin(2 * kPi * p.y() / 0.3);
  EXPECT_EQ(of(precise, Options()), 0.5);
  EXPECT_EQ(of(precise, test::with_scale(0.03)), 1.0);
  EXPECT_GT(of(wavy, Options()), 0.6);
}

/// A floor 0.6 m below a depth camera and a wall 3.5 m before it, with noise, whose disparity is rounded to an eighth of a pixel: steps of
/// 3 mm times the square of the distance in metres. `filled`: the share of the points that is rounded no more than to millimetres, as some drivers fill in.
PointCloud coarse_depth(double filled = 0) {
  PointCloud cloud;
  Random random(8);
  for (double v = -240; v < 240; v += 1.5)
    for (double u = -320; u < 320; u += 1.5) {
      const Vec3 ray(u / 575, v / 575, 1);
      double z = std::min(3.5, ray.y() > 0 ? 0.6 / ray.y() : 1e9);
      z += 0.0003 * z * z * random.normal();
      z = random.uniform() < filled ? std::round(1000 * z) / 1000 : 43 / (std::round(8 * 43 / z) / 8);
      cloud.positions.push_back(z * ray);
    }
  return cloud;
}

// The points of one step are a plane of their own at the scale that spacing and noise suggest: a floor was hundreds of slices.
TEST(ChooseScale, CoarseDepthIsNoStaircase) {
  const double step = 3.5 * 3.5 / (8 * 43);  // of the wall; it is 3.6 cm, the floor's are less
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const PointCloud& camera : {coarse_depth(), coarse_depth(0.25)})
    for (const Mat3& rotation : {Mat3(Mat3::Identity()), turn}) {
      PointCloud cloud = camera;
      test::turn(cloud, rotation);
      const double scale = scale_of(cloud);
      EXPECT_GT(scale, step);
      EXPECT_LT(scale, 4.0 * step);
      EXPECT_LT(test::run(cloud, Options()).result.planes.size(), 12u);
    }
}

/// One sweep of a spinning lidar in a room of 6 × 5 × 2.6 m: sixteen lines, 7 to 17 cm apart on the walls and points every centimetre, with noise in the range.
PointCloud sweep(double noise) {
  PointCloud cloud;
  Random random(6);
  const Vec3 from(2.4, 1.9, 1.4), size(6, 5, 2.6);
  for (int line = 0; line < 16; ++line)
    for (int k = 0; k < 1800; ++k) {
      const double up = radians(2.0 * line - 15.0), turn = radians(0.2 * k);
      const Vec3 ray(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      double range = 1e9;
      for (int axis = 0; axis < 3; ++axis) range = std::min(range, ((ray[axis] > 0 ? size[axis] : 0.0) - from[axis]) / ray[axis]);
      cloud.positions.push_back(from + (range + noise * random.normal()) * ray);
    }
  return cloud;
}

// Of a line whose noise is as wide as its points are apart, the nearest are a disc across the wall.
TEST(ChooseScale, ReachesTheNextRingOfANoisySweep) {
  for (const double noise : {0.003, 0.01, 0.02}) {
    const PointCloud cloud = sweep(noise);
    EXPECT_GT(scale_of(cloud), 0.12) << noise;
    EXPECT_LT(scale_of(cloud), 0.3) << noise;
    EXPECT_LT(test::run(cloud, Options()).result.planes.size(), 12u) << noise;
  }
}

// A building site: ground, floor and slab hold most of the points, and boards lie at any height between them.
TEST(ChooseScale, FloorsAndBoardsAreNoLevelsOfCoarseDepth) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PointCloud cloud;
    Random random(seed);
    for (const double height : {-0.5, 0.0, 3.2}) test::add_rectangle(cloud, {0, 0, height}, {14, 0, 0}, {0, 10, 0}, 0.12, 0.0015, random);
    for (int i = 0; i < 16; ++i)
      test::add_rectangle(cloud, {random.uniform(0, 12), random.uniform(0, 9), random.uniform(0.1, 3.1)}, {1.5, 0, 0}, {0, 0.3, 0}, 0.08, 0.0015, random);
    test::turn(cloud, Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix());
    Context context;
    CloudSource source(cloud, "site");
    const Arrangement found = find_planes(source, Options(), context);
    EXPECT_LT(found.scale, 0.5) << seed;
    for (const std::string& warning : found.summary.warnings) EXPECT_EQ(warning.find("levels"), std::string::npos) << warning;
  }
}

// A station squared to the yard: the columns of its scan lie at values of their own on the walls beside it, and nothing is known of the gap between two of these.
TEST(ChooseScale, ColumnsOfAScanAreNoLevels) {
  PointCloud cloud;
  Random random(12);
  for (const double from : {-1.35, 0.15})
    for (int column = 0; column < 80; ++column)
      for (int row = 0; row < 60; ++row) cloud.positions.push_back({4 + 0.002 * random.normal(), from + 0.015 * column, 0.015 * row});
  test::add_rectangle(cloud, {-9, -0.03, 0}, {12, 0, 0}, {0, 0, 4}, 0.08, 0.005, random);
  Context context;
  CloudSource source(cloud, "yard");
  const Arrangement found = find_planes(source, Options(), context);
  EXPECT_LT(found.scale, 0.2);
  for (const std::string& warning : found.summary.warnings) EXPECT_EQ(warning.find("levels"), std::string::npos) << warning;
}

/// A cloud whose source says that its depths come in steps.
class Stepped final : public PointSource {
 public:
  Stepped(const PointCloud& cloud, double rounding) : source_(cloud, "stepped"), rounding_(rounding) {}
  SourceInfo info() const override {
    SourceInfo info = source_.info();
    info.rounding = rounding_;
    return info;
  }
  bool next(PointCloud& block) override { return source_.next(block); }
  void rewind() override { source_.rewind(); }

 private:
  CloudSource source_;
  double rounding_;
};

// Frames from several sides: their levels lie across each other, and only the source knows.
TEST(ChooseScale, SpansTheStepsThatTheSourceTells) {
  const PointCloud cloud = test::box_cloud(Vec3::Zero(), {4, 3, 2}, 0.015, 0.002, 4);
  const auto found = [&](double rounding) {
    Context context;
    Stepped source(cloud, rounding);
    return find_planes(source, Options(), context);
  };
  EXPECT_LT(found(0.001).scale, 0.04);
  EXPECT_TRUE(found(0.001).summary.warnings.empty());
  const Arrangement coarse = found(0.03);
  EXPECT_NEAR(coarse.scale, 0.075, 1e-9);
  ASSERT_EQ(coarse.summary.warnings.size(), 1u);
  EXPECT_NE(coarse.summary.warnings[0].find("levels that are about 0.03 m apart"), std::string::npos) << coarse.summary.warnings[0];
}

// A model without noise: its treads are levels too, but its risers are as exact.
TEST(ChooseScale, StepsOfAModelAreReal) {
  PointCloud cloud;
  Random random(2);
  for (int i = 0; i < 14; ++i) {
    test::add_rectangle(cloud, {0, 0.09 * i, 0.06 * i}, {1, 0, 0}, {0, 0.09, 0}, 0.02, 0.0, random);
    test::add_rectangle(cloud, {0, 0.09 * (i + 1), 0.06 * i}, {1, 0, 0}, {0, 0, 0.06}, 0.02, 0.0, random);
  }
  EXPECT_LT(scale_of(cloud), 0.05);
}

// A given scale that is below the spacing of half of the scene.
TEST(ChooseScale, AGivenOneThatIsTooSmallForManyPointsIsSaid) {
  PointCloud cloud = test::box_cloud(Vec3::Zero(), {2, 2, 2}, 0.02, 0.002, 1);
  for (const Vec3& p : test::box_cloud({4, 0, 0}, {8, 8, 8}, 0.1, 0.002, 2).positions) cloud.positions.push_back(p);
  const auto warnings = [&](double scale) { return test::run(cloud, test::with_scale(scale)).result.summary.warnings; };
  ASSERT_EQ(warnings(0.02).size(), 1u);
  EXPECT_NE(warnings(0.02).front().find("of the points lie on no plane at a scale of 0.02 m: their spacing and noise ask for 0.1"), std::string::npos)
      << warnings(0.02).front();
  EXPECT_TRUE(warnings(0.2).empty());
}

}  // namespace
}  // namespace unseen::planes
