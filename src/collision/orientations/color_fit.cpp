// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/orientations/appearance.h"
#include "collision/orientations/color_sight.h"
#include "collision/orientations/silhouette_fit.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

using Matrix6 = SilhouetteFit::Matrix6;
using Vector6 = SilhouetteFit::Vector6;

constexpr int kSteps = 5;       // at each sharpness
constexpr double kBlur = 2.0;   // px of the pictures
constexpr double kStep = 0.01;  // rad, of the differences: about a third of a pixel

/// Which place of the surface is seen in which look.
struct Sight {
  std::size_t point = 0, look = 0;
};

/// How the colours differ from their places' means and the light, with the places that are seen held fixed.
class ColorFit {
 public:
  ColorFit(const std::vector<SurfacePoint>& points, const Camera& camera, const std::vector<Look>& looks)
      : points_(points), camera_(camera), looks_(looks) {}

  void choose_sights(const std::vector<Quat>& path) {
    sights_.clear();
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const std::size_t begin = sights_.size();
      for (std::size_t i = 0; i < looks_.size(); ++i)
        if (!looks_[i].picture.empty() && faces_camera(path[i] * points_[p].place + looks_[i].center, path[i] * points_[p].normal))
          sights_.push_back({p, i});
      if (sights_.size() < begin + 2) sights_.resize(begin);
    }
  }

  std::size_t size() const { return 3 * sights_.size(); }

  Eigen::VectorXd residuals(const std::vector<Quat>& path) const {
    const auto count = static_cast<Eigen::Index>(sights_.size());
    Eigen::Matrix<double, Eigen::Dynamic, 3> colors(count, 3);
    Eigen::Matrix<double, Eigen::Dynamic, kLights> lights(count, static_cast<Eigen::Index>(kLights));
    Color color = Color::Zero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const Sight& s = sights_[static_cast<std::size_t>(i)];
      const SurfacePoint& p = points_[s.point];
      (void)color_at(looks_[s.look], camera_.project(path[s.look] * p.place + looks_[s.look].center), color);
      colors.row(i) = color;
      lights.row(i) = light_basis(path[s.look] * p.normal);
    }
    center(colors);
    center(lights);
    Eigen::Matrix<double, kLights, kLights> normal = 3.0 * lights.transpose() * lights;
    normal.diagonal().array() += 3e-3 * static_cast<double>(count);
    const Light shade = solve_symmetric(normal, lights.transpose() * colors.rowwise().sum());
    colors.colwise() -= lights * shade;
    return colors.reshaped();
  }

 private:
  /// Takes the mean of each place's rows away.
  template <class Rows>
  void center(Rows& rows) const {
    for (std::size_t begin = 0, end; begin < sights_.size(); begin = end) {
      for (end = begin; end < sights_.size() && sights_[end].point == sights_[begin].point;) ++end;
      auto part = rows.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
      const auto mean = part.colwise().mean().eval();
      part.rowwise() -= mean;
    }
  }

  const std::vector<SurfacePoint>& points_;
  const Camera& camera_;
  const std::vector<Look>& looks_;
  std::vector<Sight> sights_;
};

std::vector<Look> blurred(std::vector<Look> looks) {
  for (Look& look : looks) {
    cv::Mat smooth;
    if (!look.picture.empty()) cv::GaussianBlur(look.picture, smooth, {}, kBlur);
    look.picture = smooth;
  }
  return looks;
}

/// A few damped steps of Gauss and Newton at one sharpness. The colours' cost is that of normal noise of unknown variance, N log Σr².
void descend(Turning& best, const SilhouetteFit& outlines, ColorFit& colors, double worth, double noise) {
  const double share = 1.0 / (noise * noise);
  double damping = 1e-3;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Quat> path = outlines.path(best);
    colors.choose_sights(path);
    if (colors.size() < 60) return;
    const Eigen::VectorXd r = colors.residuals(path);
    const double weight = worth / std::max(r.squaredNorm(), 1e-9);
    Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(r.size(), 6);
    for (int k = 0; k < 6; ++k)
      jacobian.col(k) = (colors.residuals(outlines.path(outlines.moved(best, kStep * Vector6::Unit(k)))) -
                         colors.residuals(outlines.path(outlines.moved(best, -kStep * Vector6::Unit(k))))) / (2.0 * kStep);
    Matrix6 normal;
    Vector6 gradient;
    const SilhouetteFit::Residuals outline = outlines.residuals(best);
    outlines.linearise(best, outline, normal, gradient);
    normal = share * normal + weight * jacobian.transpose() * jacobian;
    gradient = share * gradient + weight * jacobian.transpose() * r;
    const double cost = share * SilhouetteFit::cost(outline) + worth * std::log(r.squaredNorm());
    Vector6 unit;
    unit << 1, 1, 1, Vec3::Constant(1.0 / outlines.momentum_unit());
    best.information = unit.asDiagonal() * normal * unit.asDiagonal();
    best.information *= noise * noise;
    bool moved = false;
    for (int attempt = 0; attempt < 4 && !moved; ++attempt) {
      Matrix6 damped = normal;
      damped.diagonal() *= 1.0 + damping;
      Turning next = outlines.moved(best, -solve_symmetric(damped, gradient));
      const SilhouetteFit::Residuals there = outlines.residuals(next);
      next.cost = SilhouetteFit::cost(there);
      moved = share * next.cost + worth * std::log(colors.residuals(outlines.path(next)).squaredNorm()) < cost;
      damping = moved ? 0.2 * damping : std::max(10.0 * damping, 1e-2);
      if (moved) best = next;
    }
    if (!moved) return;
  }
}

}  // namespace

Turning refined_by_colors(const Turning& start, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks,
                          const std::vector<SurfacePoint>& points, double noise) {
  const SilhouetteFit outlines(body, camera, looks, 0, looks.size());
  const double worth = kColorsPerLook * static_cast<double>(looks.size());
  const std::vector<Look> soft = blurred(looks);
  Turning best = at_time(start, body, outlines.middle());
  best.cost = SilhouetteFit::cost(outlines.residuals(best));
  ColorFit coarse(points, camera, soft), fine(points, camera, looks);
  descend(best, outlines, coarse, worth, noise);
  descend(best, outlines, fine, worth, noise);
  return best;
}

}  // namespace unseen::collision
