// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/centering.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "unseen/collision/body_mesh.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kFlat = 1e-3;         // of the size: a vertex that far outside a face is a dent
constexpr std::size_t kMostPairs = 100'000'000;  // of faces and vertices that are looked at for dents
constexpr int kRaster = 320;           // px, of a drawn silhouette
constexpr double kSize = 0.03;         // share by which all sizes of a flight may be off together
constexpr double kOddLeast = 0.015, kOddMost = 0.1;  // of the logarithm of the area, off the flight's median
constexpr double kOddOfFlight = 5.0;     // the same in the flight's own spread
constexpr double kMostLeftOut = 0.5;   // of a flight's points: more, and the pose is wrong, not the points

bool is_convex(const TriangleMesh& mesh) {
  if (mesh.vertices.size() * mesh.triangles.size() > kMostPairs) return false;
  double size = 0.0, volume = 0.0;
  for (const Vec3& v : mesh.vertices) size = std::max(size, v.norm());
  for (const auto& t : mesh.triangles) volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    Vec3 normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    if (normal.norm() < 1e-12 * size * size) continue;
    normal *= (volume < 0.0 ? -1.0 : 1.0) / normal.norm();
    for (const Vec3& v : mesh.vertices)
      if (normal.dot(v - a) > kFlat * size) return false;
  }
  return true;
}

/// Area and centroid from moments of a picture or of a polygon.
Figure figure_of(const cv::Moments& m) {
  const double area = std::max(std::abs(m.m00), 1e-9);
  return {{m.m10 / m.m00, m.m01 / m.m00}, area};
}

/// Of triangles drawn over one another.
Figure drawn(const std::vector<cv::Point2f>& pixels, const TriangleMesh& mesh) {
  constexpr int kShift = 8;
  const cv::Rect box = cv::boundingRect(pixels);
  const double scale = kRaster / static_cast<double>(std::max({1, box.width, box.height}));
  cv::Mat mask = cv::Mat::zeros(kRaster + 6, kRaster + 6, CV_8U);
  for (const auto& t : mesh.triangles) {
    std::array<cv::Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const cv::Point2f p = (pixels[t[i]] - cv::Point2f(box.tl())) * scale;
      corners[i] = {static_cast<int>(std::lround((p.x + 3) * (1 << kShift))), static_cast<int>(std::lround((p.y + 3) * (1 << kShift)))};
    }
    cv::fillConvexPoly(mask, corners.data(), 3, cv::Scalar(255), cv::LINE_8, kShift);
  }
  Figure f = figure_of(cv::moments(mask, true));
  f.centroid = (f.centroid - Vec2(3, 3)) / scale + Vec2(box.x, box.y);
  f.area /= scale * scale;
  return f;
}

}  // namespace

FigureMaker::FigureMaker(const Body& body, const std::string& source) : body_(body) {
  if (body.shape != Shape::box && body.shape != Shape::mesh) return;
  mesh_ = body_mesh(body, source);
  convex_ = body.shape == Shape::box || is_convex(mesh_);
}

Figure FigureMaker::at(const Quat& q, const Vec3& center, const Camera& camera) const {
  if (mesh_.vertices.empty()) {  // a sphere's outline is an ellipse (see candidates.cpp)
    const double square = std::pow(body_.radius / center.z(), 2), wider = 1.0 / (1.0 - square);
    const Vec2 principal(camera.cx, camera.cy), middle = camera.project(center) - principal;
    const double tilt = center.squaredNorm() / (center.z() * center.z());
    const double area = kPi * camera.fx * camera.fy * square * wider * std::sqrt((tilt - square) * wider);
    return {principal + wider * middle, area};
  }
  const Mat3 turn = q.toRotationMatrix();
  std::vector<cv::Point2f> pixels, hull;
  for (const Vec3& v : mesh_.vertices) {
    const Vec3 place = turn * v + center;
    const Vec2 p = camera.project({place.x(), place.y(), std::max(place.z(), 0.01)});
    pixels.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  if (!convex_) return drawn(pixels, mesh_);
  cv::convexHull(pixels, hull);
  const cv::Point2f origin = hull.front();
  for (cv::Point2f& p : hull) p -= origin;
  Figure f = figure_of(cv::moments(hull));
  f.centroid += Vec2(origin.x, origin.y);
  return f;
}

std::vector<PointObservation> centered(const std::vector<PointObservation>& points, const Problem& problem,
                                       const std::array<FigureMaker, 2>& makers, const PoseOf& pose) {
  std::vector<PointObservation> result;
  for (const int body : {0, 1})
    for (const bool after : {false, true}) {
      std::vector<PointObservation> flight, whole;
      std::vector<double> ratios;
      for (PointObservation p : points) {
        if (p.body != body || p.after != after) continue;
        Vec3 center;
        Quat q;
        double ratio = 0.0;
        if (pose(p, center, q)) {
          const Solid& solid = problem.solids[static_cast<std::size_t>(body)];
          const Figure f = makers[static_cast<std::size_t>(body)].at(q * solid.file_to_principal, center, problem.camera);
          p.pixel -= f.centroid - problem.camera.project(center);
          if (p.depth > 0.0) {
            const double diameter = problem.camera.fx * solid.mass.extent / p.depth;
            ratio = std::log(f.area / (0.25 * kPi * diameter * diameter));
            p.depth = center.z() * std::exp(0.5 * ratio);
          }
        }
        flight.push_back(p);
        ratios.push_back(ratio);
      }
      if (flight.empty()) continue;
      const double typical = median(ratios);
      std::vector<double> off;
      for (const double r : ratios) off.push_back(std::abs(r - typical));
      const double odd = std::clamp(kOddOfFlight * 1.4826 * median(off), kOddLeast, kOddMost), sigma = kSize * std::sqrt(static_cast<double>(flight.size()));
      for (std::size_t i = 0; i < flight.size(); ++i) {
        if (ratios[i] != 0.0) flight[i].depth_sigma = std::min(flight[i].depth_sigma, sigma);
        if (ratios[i] == 0.0 || std::abs(ratios[i] - typical) < odd) whole.push_back(flight[i]);
      }
      const auto& kept = static_cast<double>(whole.size()) < (1.0 - kMostLeftOut) * static_cast<double>(flight.size()) ? flight : whole;
      result.insert(result.end(), kept.begin(), kept.end());
    }
  return result;
}

}  // namespace unseen::collision
