// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Noise that is smooth over a metre, as fused depth and photogrammetry have it.
#include <gtest/gtest.h>

#include <algorithm>

#include "planes/patches/patches.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

constexpr double kSpacing = 0.02, kWhite = 0.0005;  // m
const double kAngle = radians(15.0);

/// A smooth random height over a plane: the sum of plane waves 0.7 to 1.4 m long.
class Wavy {
 public:
  Wavy(double rms, Random& random) : height_(rms * std::sqrt(2.0 / kWaves)) {
    for (int k = 0; k < kWaves; ++k) {
      const double length = 0.7 + 0.7 * random.uniform(), towards = 2.0 * kPi * random.uniform();
      waves_.emplace_back(2.0 * kPi / length * std::cos(towards), 2.0 * kPi / length * std::sin(towards), 2.0 * kPi * random.uniform());
    }
  }
  double operator()(double x, double y) const {
    double sum = 0;
    for (const Vec3& w : waves_) sum += std::cos(w.x() * x + w.y() * y + w.z());
    return height_ * sum;
  }

 private:
  static constexpr int kWaves = 24;
  double height_;
  std::vector<Vec3> waves_;
};

/// A rectangle with waves of their own of this rms (m).
void add_wavy(PointCloud& cloud, const Vec3& origin, const Vec3& a, const Vec3& b, double rms, Random& random) {
  const Wavy wavy(rms, random);
  const std::size_t from = cloud.size();
  test::add_rectangle(cloud, origin, a, b, kSpacing, kWhite, random);
  for (std::size_t i = from; i < cloud.size(); ++i) {
    const Vec3 d = cloud.positions[i] - origin;
    cloud.positions[i] += wavy(d.dot(a.normalized()), d.dot(b.normalized())) * a.cross(b).normalized();
  }
}

Patches patches_of(const PointCloud& cloud) {
  VoxelGrid grid = test::grid_of(cloud, 0.02);
  Context context;
  context.threads = 2;
  return segment(grid, estimate_normals(grid, {}, context), {}, kAngle, context);
}

/// Mean squared tilt from level, of patches of less than 1 m², over what they are uncertain by.
double tilts_of_small(const Patches& patches, int& count) {
  double sum = 0;
  count = 0;
  for (const Patch& p : patches.patches) {
    if (p.area > 1.0 || p.area < 0.1) continue;
    sum += std::pow(p.fit.u.z(), 2) / p.variance_u + std::pow(p.fit.v.z(), 2) / p.variance_v;
    count += 2;
  }
  return sum / count;
}

/// Level squares of 0.6 m, and a level floor of 6 m.
PointCloud squares(double rms) {
  PointCloud cloud;
  Random random(3);
  add_wavy(cloud, {0, 0, 0}, {6, 0, 0}, {0, 6, 0}, rms, random);
  for (int i = 0; i < 30; ++i) add_wavy(cloud, {1.0 * (i % 6), 1.0 * (i / 6), 1.0}, {0.6, 0, 0}, {0, 0.6, 0}, rms, random);
  return cloud;
}

TEST(Waves, SmallSurfacesAreAsUncertainAsTheyAreTurned) {
  int count = 0;
  const double squared = tilts_of_small(patches_of(squares(0.004)), count);
  EXPECT_GE(count, 60);
  EXPECT_GT(squared, 0.3);
  EXPECT_LT(squared, 3.0);
}

/// Where noise is independent the squares know their tilt to 0.01°, and large surfaces do not say otherwise.
TEST(Waves, IndependentNoiseLeavesNone) {
  const Patches patches = patches_of(squares(0.0));
  int count = 0;
  const double squared = tilts_of_small(patches, count);
  EXPECT_EQ(count, 60);
  EXPECT_GT(squared, 0.3);
  EXPECT_LT(squared, 3.0);
  for (const Patch& p : patches.patches) EXPECT_LT(std::sqrt(p.variance_u), radians(0.02));
}

/// A curved surface is turned from its chord everywhere: these are no waves.
TEST(Waves, ABowHasNone) {
  PointCloud cloud = squares(0.0);
  const std::size_t floor = 300 * 300;
  for (std::size_t i = 0; i < floor; ++i) cloud.positions[i].z() += 0.004 * std::pow(cloud.positions[i].x() - 3.0, 2);
  for (const Patch& p : patches_of(cloud).patches) {
    if (p.area < 1.0) {
      EXPECT_LT(std::sqrt(p.variance_u), radians(0.05));
    }
  }
}

/// A room of 5 by 4 by 2.5 m with a table and a chest in it, all square to each other, turned by 20°.
PointCloud room(double rms) {
  PointCloud cloud;
  Random random(8);
  const auto add_box = [&](const Vec3& at, const Vec3& size) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {0.0, size[axis]})
        add_wavy(cloud, at + side * Vec3::Unit(axis), Vec3::Unit((axis + 1) % 3) * size[(axis + 1) % 3], Vec3::Unit((axis + 2) % 3) * size[(axis + 2) % 3], rms, random);
  };
  add_box({0, 0, 0}, {5, 4, 2.5});
  add_box({1, 1, 0.4}, {1.4, 0.8, 0.4});
  add_box({3.2, 2.4, 0.3}, {0.7, 0.6, 0.9});
  test::turn(cloud, Eigen::AngleAxisd(radians(20.0), Vec3::UnitZ()).toRotationMatrix());
  return cloud;
}

TEST(Waves, ARoomIsNeitherCutNorTurned) {
  const Arrangement result = test::run(room(0.002), {}).result;
  EXPECT_LE(result.planes.size(), 20u);
  EXPECT_GE(std::count_if(result.planes.begin(), result.planes.end(), [](const ArrangedPlane& plane) { return plane.frame == 0; }), 16);
}

/// A ground that undulates says little of boxes that are flat: their own pieces show no waves. Three of four sides at least keep their yaw.
TEST(Waves, OfTheGroundHardlyTurnBoxes) {
  PointCloud cloud;
  Random random(6);
  add_wavy(cloud, {0, 0, 0}, {8, 0, 0}, {0, 6, 0}, 0.004, random);
  const std::vector<double> yaws = {0.0, 1.5, -2.0, 2.5};  // deg
  for (std::size_t k = 0; k < yaws.size(); ++k) {
    PointCloud box = test::box_cloud({-0.3, -0.3, 0.3}, {0.6, 0.6, 0.6}, kSpacing, 0.003, 10 + k);
    test::turn(box, Eigen::AngleAxisd(radians(yaws[k]), Vec3::UnitZ()).toRotationMatrix());
    for (const Vec3& p : box.positions) cloud.positions.push_back(p + Vec3(1.0 + 2.0 * static_cast<double>(k), 3.0, 0));
  }
  std::vector<int> found(yaws.size(), 0);
  for (const ArrangedPlane& plane : test::run(cloud, {}).result.planes) {
    if (std::abs(plane.plane.normal.z()) > 0.1) continue;
    const double turned = degrees(std::atan2(plane.plane.normal.y(), plane.plane.normal.x())), yaw = turned - 90.0 * std::round(turned / 90.0);
    for (std::size_t k = 0; k < yaws.size(); ++k) found[k] += std::abs(yaw - yaws[k]) < 0.3;
  }
  for (std::size_t k = 0; k < yaws.size(); ++k) EXPECT_GE(found[k], 3) << yaws[k];
}

/// Bends of 2° are cut, though waves of the same rms are not.
TEST(Split, WavesAreNoBends) {
  const auto pieces = [](const PointCloud& cloud) {
    const VoxelGrid grid = test::grid_of(cloud, 0.02);
    CellSets whole(1);
    for (std::size_t i = 0; i < grid.size(); ++i) whole[0].push_back(static_cast<int>(i));
    Context context;
    return split_regions(grid, {}, whole, context).size();
  };
  PointCloud wavy, bent;
  Random random(5);
  add_wavy(wavy, {0, 0, 0}, {1.2, 0, 0}, {0, 0.8, 0}, 0.004, random);
  EXPECT_EQ(pieces(wavy), 1u);
  add_wavy(bent, {-0.6, 0, 0}, {0.6, 0, 0}, {0, 0.8, 0}, 0.0, random);
  add_wavy(bent, {0, 0, 0}, {0.6 * std::cos(radians(2.0)), 0, 0.6 * std::sin(radians(2.0))}, {0, 0.8, 0}, 0.0, random);
  EXPECT_EQ(pieces(bent), 2u);
}

}  // namespace
}  // namespace unseen::planes
