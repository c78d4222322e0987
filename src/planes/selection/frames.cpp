// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/frames.h"

#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

void add_line(std::vector<Vec3>& lines, const Vec3& line) {
  for (const Vec3& l : lines)
    if (line_angle(l, line) < 1e-9) return;
  lines.push_back(line);
}

/// Angle of two lines. Rounding of small angles, up to 1e-8, costs nothing here.
double angle_of(double cosine) { return std::acos(std::min(std::abs(cosine), 1.0)); }

/// Largest cosine between a line and the directions of a frame in whose coordinates it is given.
double nearest_cosine(const Vec3& line, const std::vector<Vec3>& locals) {
  double largest = 0;
  for (const Vec3& l : locals) largest = std::max(largest, std::abs(l.dot(line)));
  return largest;
}

}  // namespace

double AngleSet::deviation(double angle) const {
  double least = kPi;
  for (const double theta : all)
    least = std::min({least, std::abs(theta - angle), std::abs(theta - (kPi - angle))});
  return least;
}

AngleSet make_angles(const std::vector<double>& generators) {
  AngleSet set;
  set.all.push_back(0.0);
  for (const double g : generators)
    for (int k = 1; g > 0 && k * g < kPi - 1e-9; ++k) set.all.push_back(k * g);
  std::sort(set.all.begin(), set.all.end());
  set.all.erase(std::unique(set.all.begin(), set.all.end(), [](double a, double b) { return b - a < 1e-9; }),
                set.all.end());
  for (const double a : set.all) set.has_right_angle = set.has_right_angle || std::abs(a - kPi / 2) < 1e-9;
  return set;
}

std::vector<Vec3> local_directions(const AngleSet& angles, const Space& space) {
  const Mat3 axes = Mat3::Identity();
  std::vector<Vec3> lines;
  const int generators = angles.has_right_angle ? (space.is_2d() ? 2 : 3) : 1;
  for (int a = 0; a < generators; ++a) lines.push_back(axes.col(a));
  for (int a = 0; a < generators; ++a)
    for (int b = 0; b < 3; ++b) {
      if (a == b || ((space.is_2d() || !angles.has_right_angle) && b != 2)) continue;
      for (const double theta : angles.all)
        add_line(lines, Eigen::AngleAxisd(theta, axes.col(b)) * Vec3(axes.col(a)));
    }
  return lines;
}

OrientationFrame close_frame(const Vec3& a, const Vec3& b, const Space& space) {
  OrientationFrame frame;
  frame.closed = true;
  const Vec3 third = space.is_2d() ? *space.flat_axis : Vec3(a.cross(b).normalized());
  frame.axes << a, third.cross(a).normalized(), third;
  return frame;
}

OrientationFrame open_frame(const Vec3& a, const Space& space) {
  // In 2D the plane closes every direction.
  OrientationFrame frame = close_frame(a, any_orthogonal(a), space);
  frame.closed = space.is_2d();
  return frame;
}

double irregularity(const OrientationFrame& a, const OrientationFrame& b, const std::vector<Vec3>& locals,
                    const AngleSet& angles) {
  double sum = 0;
  std::size_t count = 1;
  if (a.closed && b.closed) {
    const Mat3 turn = a.axes.transpose() * b.axes;
    if (locals.size() == 3) {  // the axes alone
      const Mat3 cosines = turn.cwiseAbs();
      for (int i = 0; i < 3; ++i) sum += angle_of(cosines.col(i).maxCoeff()) + angle_of(cosines.row(i).maxCoeff());
    } else {
      for (const Vec3& l : locals)
        sum += angle_of(nearest_cosine(turn * l, locals)) + angle_of(nearest_cosine(turn.transpose() * l, locals));
    }
    count = 2 * locals.size();
  } else if (a.closed || b.closed) {
    const OrientationFrame &closed = a.closed ? a : b, &open = a.closed ? b : a;
    const Vec3 single = closed.axes.transpose() * open.axes.col(0);
    sum = angle_of(nearest_cosine(single, locals));
    for (const Vec3& l : locals) sum += angles.deviation(angle_of(l.dot(single)));
    count = 1 + locals.size();
  } else {
    sum = angles.deviation(angle_of(a.axes.col(0).dot(b.axes.col(0))));
  }
  return 1.0 - std::exp(-3.0 * sum / static_cast<double>(count));
}

double tilt_chi2(const Patch& patch, const Vec3& normal) {
  const PlaneFit& fit = patch.fit;
  const double across = std::max(std::abs(normal.dot(fit.normal)), 1e-9);
  const double tu = normal.dot(fit.u) / across, tv = normal.dot(fit.v) / across;
  return tu * tu / patch.doubt_u + tv * tv / patch.doubt_v;
}

double noise_chi2(const Patch& patch, const Vec3& normal) {
  const PlaneFit& fit = patch.fit;
  const double across = std::max(std::abs(normal.dot(fit.normal)), 1e-9);
  const auto chi2 = [&](double tilt, double variance, double spread) { return spread > 0.0 ? tilt * tilt / tilt_noise(patch.moments, fit, variance, spread) : 0.0; };  // lines have one tilt
  return chi2(normal.dot(fit.u) / across, patch.variance_u, fit.spread_u) + chi2(normal.dot(fit.v) / across, patch.variance_v, fit.spread_v);
}

double certain_at(double lambda) { return kCertain * std::max(1.0, (1.0 - lambda) / lambda); }

double data_cost(const Patch& patch, const Vec3& normal) {
  const double x = tilt_chi2(patch, normal) / 9.0;
  return 2.0 * x * x * x / (x * x + 1.0);
}

Candidate best_candidate(const Patch& patch, const OrientationFrame& frame, const std::vector<Vec3>& locals,
                         double angle) {
  Candidate best;
  const double cos_angle = std::cos(angle);
  const std::size_t count = frame.closed ? locals.size() : 1;
  for (std::size_t l = 0; l < count; ++l) {
    const Vec3 n = frame.closed ? frame.direction(locals[l]) : Vec3(frame.axes.col(0));
    if (std::abs(n.dot(patch.fit.normal)) < cos_angle) continue;
    const double cost = data_cost(patch, n);
    if (cost < best.cost) best = {cost, static_cast<int>(l)};
  }
  return best;
}

}  // namespace unseen::planes
