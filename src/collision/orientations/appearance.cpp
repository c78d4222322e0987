// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/appearance.h"

#include <algorithm>
#include <cmath>

#include "collision/orientations/color_sight.h"
#include "core/linear.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// Sums for a least-squares fit of lights to colours about each place's own mean.
struct Sums {
  Eigen::Matrix<double, kLights, kLights> lights = Eigen::Matrix<double, kLights, kLights>::Zero();
  Light mixed = Light::Zero();
  double colors = 0;
  double freedom = 0;

  void add(const std::vector<std::pair<Color, Light>>& sights) {
    if (sights.size() < 2) return;
    Color color = Color::Zero();
    Light light = Light::Zero();
    for (const auto& [c, l] : sights) color += c, light += l;
    color /= static_cast<double>(sights.size());
    light /= static_cast<double>(sights.size());
    for (const auto& [c, l] : sights) {
      const Light d = l - light;
      lights += 3.0 * d * d.transpose();  // one light for all three channels
      mixed += d * (c - color).sum();
      colors += (c - color).squaredNorm();
    }
    freedom += 3.0 * static_cast<double>(sights.size() - 1);
  }

  double variance() const {
    if (freedom <= 2.0 * kLights) return 0.0;
    Eigen::Matrix<double, kLights, kLights> regular = lights;
    regular.diagonal().array() += 1e-3 * freedom;
    const double explained = mixed.dot(solve_symmetric(regular, mixed));
    return std::max(colors - explained, 1e-12) / freedom;
  }
};

}  // namespace

std::vector<SurfacePoint> surface_points(const Body& body, const SpinBody& solid, std::size_t count, const std::string& source) {
  const TriangleMesh mesh = body_mesh(body, source);
  std::vector<double> upto;
  double area = 0.0;
  for (const auto& t : mesh.triangles)
    upto.push_back(area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm());
  Vec3 outward = Vec3::Zero();  // tells which way the triangles run
  for (const auto& t : mesh.triangles) outward.x() += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  const double sign = outward.x() < 0.0 ? -1.0 : 1.0;
  Random random(1);
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < count && area > 0.0; ++i) {
    const double at = area * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto& t = mesh.triangles[static_cast<std::size_t>(std::lower_bound(upto.begin(), upto.end() - 1, at) - upto.begin())];
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double root = std::sqrt(random.uniform()), s = random.uniform();
    const Vec3 place = (1.0 - root) * a + root * (1.0 - s) * b + root * s * c;
    const Quat& turn = solid.solid.file_to_principal;
    points.push_back({turn * place, turn * Vec3(sign * (b - a).cross(c - a).normalized())});
  }
  return points;
}

double color_variance(const std::vector<SurfacePoint>& points, const Camera& camera, const std::vector<const Look*>& looks,
                      const std::vector<Quat>& orientations) {
  std::vector<Mat3> turns;
  for (const Quat& q : orientations) turns.push_back(q.toRotationMatrix());
  Sums sums;
  std::vector<std::pair<Color, Light>> sights;
  for (const SurfacePoint& p : points) {
    sights.clear();
    for (std::size_t i = 0; i < looks.size(); ++i) {
      if (looks[i]->picture.empty()) continue;
      const Vec3 place = turns[i] * p.place + looks[i]->center, normal = turns[i] * p.normal;
      if (!faces_camera(place, normal)) continue;
      Color color;
      if (color_at(*looks[i], camera.project(place), color)) sights.emplace_back(color, light_basis(normal));
    }
    sums.add(sights);
  }
  return sums.variance();
}

double color_cost(double variance, double least, double looks) {
  constexpr double kAlike = 0.2;  // of the logarithm
  return kColorsPerLook * looks * std::max(0.0, std::log(variance / least) - kAlike);
}

}  // namespace unseen::collision
