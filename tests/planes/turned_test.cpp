// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "planes/scenes.h"

// What is turned by one to three degrees and knows it: frames must not turn it out of its own points, and say by how much they did.
namespace unseen::planes {
namespace {

/// Faces of a scene and the points that lie on them.
struct Faces {
  PointCloud cloud;
  std::vector<Vec3> normal;
  std::vector<std::size_t> first;  ///< point of each face

  void add(const Vec3& origin, const Vec3& a, const Vec3& b, double spacing, double noise, Random& random) {
    first.push_back(cloud.size());
    normal.push_back(a.cross(b).normalized());
    test::add_rectangle(cloud, origin, a, b, spacing, noise, random);
  }
  std::size_t end(std::size_t face) const { return face + 1 < first.size() ? first[face + 1] : cloud.size(); }
};

/// The plane that has most of a face's points.
int plane_of(const Faces& faces, std::size_t face, const test::Run& r) {
  std::vector<int> count(r.result.planes.size(), 0);
  for (std::size_t i = faces.first[face]; i < faces.end(face); ++i)
    if (r.plane_of_point[i] >= 0) ++count[r.plane_of_point[i]];
  return static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
}

/// Saddle roofs from above along one ridge line, two rows of them.
Faces street(const std::vector<double>& pitches, double spacing, double noise, std::uint64_t seed) {
  Faces roofs;
  Random random(seed);
  for (std::size_t i = 0; i < pitches.size(); ++i) {
    const double rise = 4.0 * std::tan(radians(pitches[i]));
    const Vec3 ridge(11.0 * static_cast<double>(i % 4), 22.0 * static_cast<double>(i / 4), 6.0 + rise);
    for (const double side : {-1.0, 1.0}) roofs.add(ridge, side * Vec3(9, 0, 0), Vec3(0, 4 * side, -rise), spacing, noise, random);
  }
  for (std::size_t f = 0; f < roofs.first.size(); f += 2)  // the left sides start at the ridge's other end
    for (std::size_t i = roofs.first[f]; i < roofs.first[f + 1]; ++i) roofs.cloud.positions[i].x() += 9;
  test::turn(roofs.cloud, Eigen::AngleAxisd(radians(20.0), Vec3::UnitZ()).toRotationMatrix());
  for (Vec3& n : roofs.normal) n = Eigen::AngleAxisd(radians(20.0), Vec3::UnitZ()) * n;
  return roofs;
}

TEST(TurnedPlanes, RoofsOfAStreetKeepTheirPitch) {
  struct Scan {
    double spacing, noise, off;  // m, m, deg
  };
  for (const Scan& scan : {Scan{0.25, 0.01, 0.75}, Scan{0.18, 0.02, 1.1}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Faces roofs = street({31.5, 33, 34.5, 36, 33.75, 35, 37.5, 39}, scan.spacing, scan.noise, seed);
      const test::Run r = test::run(roofs.cloud, {});
      for (std::size_t f = 0; f < roofs.normal.size(); ++f) {
        const ArrangedPlane& plane = r.result.planes[plane_of(roofs, f, r)];
        EXPECT_LT(degrees(line_angle(plane.plane.normal, roofs.normal[f])), scan.off) << "roof " << f << " seed " << seed << " noise " << scan.noise;
        EXPECT_LT(plane.rms, 2.5 * scan.noise) << "roof " << f << " seed " << seed << " noise " << scan.noise;
      }
    }
}

/// A room with a cabinet that is turned by two degrees; of its narrow sides a scan has few points.
Faces cabinet(std::uint64_t seed) {
  const double noise = 0.005;
  Faces faces;
  Random random(seed);
  const Mat3 axes = Eigen::AngleAxisd(radians(2.0), Vec3::UnitZ()).toRotationMatrix();
  const Vec3 corner(1.2, 0.4, 0), wide = 0.9 * axes.col(0), deep = 0.45 * axes.col(1), high(0, 0, 1.6);
  faces.add(corner, deep, high, 0.09, noise, random);
  faces.add(corner + wide, deep, high, 0.09, noise, random);
  faces.add(corner, wide, high, 0.035, noise, random);
  faces.add(corner + deep, wide, high, 0.09, noise, random);
  faces.add({0, 0, 0}, {5, 0, 0}, {0, 4, 0}, 0.03, noise, random);
  faces.add({0, 0, 2.5}, {5, 0, 0}, {0, 4, 0}, 0.05, noise, random);
  for (const double side : {0.0, 1.0}) {
    faces.add({0, 4 * side, 0}, {5, 0, 0}, {0, 0, 2.5}, 0.04, noise, random);
    faces.add({5 * side, 0, 0}, {0, 4, 0}, {0, 0, 2.5}, 0.04, noise, random);
  }
  return faces;
}

TEST(TurnedPlanes, NarrowSidesOfACabinetGoWithItsFront) {
  int square = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Faces faces = cabinet(seed);
    const test::Run r = test::run(faces.cloud, {});
    const Vec3 front = r.result.planes[plane_of(faces, 2, r)].plane.normal;
    EXPECT_LT(degrees(line_angle(front, faces.normal[2])), 0.3) << seed;
    for (const std::size_t side : {0u, 1u}) square += std::abs(front.dot(r.result.planes[plane_of(faces, side, r)].plane.normal)) < 1e-6;
  }
  EXPECT_GE(square, 18);
}

/// What stands close before the middle of a turned cabinet, square to the room, is not one of its sides.
TEST(TurnedPlanes, BoxesBeforeACabinetStaySquare) {
  int square = 0, sides = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Faces faces = cabinet(seed);
    Random random(seed + 100);
    const std::size_t first = faces.first.size();
    const Mat3 axes = Eigen::AngleAxisd(radians(-2.0), Vec3::UnitZ()).toRotationMatrix();
    const Vec3 corner(1.0, 2.6, 0), wide = 3.0 * axes.col(0), high(0, 0, 1.7);
    for (const double at : {1.1, 1.6}) {
      const Vec3 box(corner.x() + at, corner.y() - 0.5, 0);
      for (const double side : {0.0, 0.35}) faces.add(box + Vec3(side, 0, 0), {0, 0.35, 0}, {0, 0, 0.5}, 0.05, 0.005, random);
      faces.add(box, {0.35, 0, 0}, {0, 0, 0.5}, 0.05, 0.005, random);
      faces.add(box + Vec3(0, 0, 0.5), {0.35, 0, 0}, {0, 0.35, 0}, 0.05, 0.005, random);
    }
    const std::size_t last = faces.first.size();
    faces.add(corner, wide, high, 0.035, 0.005, random);
    faces.add(corner + 0.4 * axes.col(1), wide, high, 0.06, 0.005, random);
    const test::Run r = test::run(faces.cloud, {});
    for (std::size_t f = first; f < last; ++f, ++sides) square += degrees(line_angle(r.result.planes[plane_of(faces, f, r)].plane.normal, faces.normal[f])) < 0.1;
  }
  EXPECT_GE(square, sides - 4) << sides;
}

/// A roof in three pieces that its frame turns out of their points is one plane again once it is set free.
TEST(TurnedPlanes, PiecesThatAreTurnedAlikeStayCoplanar) {
  Random random(7);
  Faces roofs;
  const std::vector<double> pitches = {31.5, 33, 34.5, 36, 33.75, 35};
  for (std::size_t i = 0; i < pitches.size(); ++i) {
    const double rise = 4.0 * std::tan(radians(pitches[i]));
    const Vec3 ridge(40.0 * static_cast<double>(i), 0, 6.0 + rise);
    for (const double side : {-1.0, 1.0})
      for (const double at : {0.0, 11.0, 22.0}) roofs.add(ridge + Vec3(at, 0, 0), {9, 0, 0}, {0, 4 * side, -rise}, 0.25, 0.01, random);
  }
  const test::Run r = test::run(roofs.cloud, {});
  int coplanar = 0;
  for (std::size_t f = 0; f < roofs.normal.size(); f += 3)
    for (const std::size_t other : {f + 1, f + 2}) {
      const Plane &a = r.result.planes[plane_of(roofs, f, r)].plane, &b = r.result.planes[plane_of(roofs, other, r)].plane;
      coplanar += line_angle(a.normal, b.normal) < 1e-7 && std::abs(a.offset - std::copysign(b.offset, a.offset)) < 1e-6;
    }
  EXPECT_GE(coplanar, 22);
}

/// How far planes are turned is the angle to the least-squares plane of the points that were given to them.
TEST(TurnedPlanes, TellTheAngleToTheFitOfItsPoints) {
  const Faces roofs = street({33, 34.2, 36}, 0.3, 0.02, 4);
  const test::Run r = test::run(roofs.cloud, {});
  double most = 0;
  for (std::size_t k = 0; k < r.result.planes.size(); ++k) {
    Vec3 mean = Vec3::Zero();
    double count = 0;
    for (std::size_t i = 0; i < roofs.cloud.size(); ++i)
      if (r.plane_of_point[i] == static_cast<int>(k)) mean += roofs.cloud.positions[i], ++count;
    mean /= count;
    Mat3 scatter = Mat3::Zero();
    for (std::size_t i = 0; i < roofs.cloud.size(); ++i)
      if (r.plane_of_point[i] == static_cast<int>(k)) scatter += (roofs.cloud.positions[i] - mean) * (roofs.cloud.positions[i] - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(scatter);
    const ArrangedPlane& plane = r.result.planes[k];
    EXPECT_NEAR(degrees(plane.turned), degrees(line_angle(plane.plane.normal, eigen.eigenvectors().col(0))), 1e-4);
    const double least = std::sqrt(eigen.eigenvalues()[0] / count / eigen.eigenvalues()[2]), greatest = std::sqrt(eigen.eigenvalues()[0] / count / eigen.eigenvalues()[1]);
    EXPECT_GT(plane.turned_error, 0.99 * least);  // of noise that is independent, along the wide side and across it; no more points count than so many
    EXPECT_LT(plane.turned_error, 3.0 * greatest);
    most = std::max(most, plane.turned);
  }
  EXPECT_GT(degrees(most), 0.1);
}

}  // namespace
}  // namespace unseen::planes
