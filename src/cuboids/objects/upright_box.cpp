// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/upright_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/linear.h"

namespace unseen::cuboids {
namespace {

constexpr double kOffSigmas = 3.0;  // a point farther off its side counts as unexplained
constexpr double kFacesUp = 0.7;
constexpr double kSeen = 0.03;  // of the samples, of a side that was seen
constexpr int kFitRounds = 3;

/// Mean of the values in the window of a given width that holds most of them.
double mode(std::vector<double> values, double width) {
  std::sort(values.begin(), values.end());
  std::size_t best = 0, at = 0, low = 0;
  for (std::size_t high = 0; high < values.size(); ++high) {
    while (values[high] - values[low] > width) ++low;
    if (high - low + 1 > best) best = high - low + 1, at = low;
  }
  double sum = 0;
  for (std::size_t k = at; k < at + best; ++k) sum += values[k];
  return sum / static_cast<double>(best);
}

struct UprightBox {
  double yaw = 0;
  std::array<Vec2, 4> out;     ///< normals of the four sides
  std::array<double, 5> at{};  ///< m, of the four sides and the top along their normals
  std::array<char, 5> ends{};  ///< whether enough was seen of a side to say that the box ends there

  void turn_to(double angle) {
    yaw = angle;
    for (int k = 0; k < 4; ++k) out[k] = {std::cos(yaw + 0.5 * kPi * k), std::sin(yaw + 0.5 * kPi * k)};
  }
  double place(int k, const Vec3& p) const { return k == 4 ? p.z() : out[k].dot(p.head<2>()); }
  int side(const Vec3& normal) const {
    if (normal.z() > kFacesUp) return 4;
    int best = 0;
    for (int k = 1; k < 4; ++k)
      if (out[k].dot(normal.head<2>()) > out[best].dot(normal.head<2>())) best = k;
    return best;
  }
  /// From its own side, in units of what is allowed.
  double off(const Sample& s) const {
    const int k = side(s.n);
    return (place(k, s.p) - at[k]) / (kOffSigmas * s.sigma);
  }
  bool holds(const Sample& s) const {
    for (int k = 0; k < 5; ++k)
      if (ends[k] && place(k, s.p) - at[k] > kOffSigmas * s.sigma) return false;
    return true;
  }
};

/// Angle by which explained samples ask the box to turn.
double turn_asked(const UprightBox& box, std::span<const Sample> samples) {
  std::array<std::array<double, 5>, 4> sums{};  // count, along, off, along², along · off
  for (const Sample& s : samples) {
    const int k = box.side(s.n);
    if (k == 4 || std::abs(box.off(s)) > 1.0) continue;
    const double along = -box.out[k].y() * s.p.x() + box.out[k].x() * s.p.y(), off = box.place(k, s.p) - box.at[k];
    const std::array<double, 5> terms{1.0, along, off, along * along, along * off};
    for (int t = 0; t < 5; ++t) sums[k][t] += terms[t];
  }
  double numerator = 0, denominator = 1e-12;
  for (const auto& [count, along, off, square, product] : sums)
    if (count > 2.0) numerator += product - along * off / count, denominator += square - along * along / count;
  return -numerator / denominator;
}

double mean_sigma(std::span<const Sample> samples) {
  double sum = 0;
  for (const Sample& s : samples) sum += s.sigma;
  return sum / static_cast<double>(samples.size());
}

/// Turned as the normals say, then as the places do; each side where most of its samples are.
UprightBox fit_upright(std::span<const Sample> samples) {
  UprightBox box;
  Vec2 turn = Vec2::Zero();
  for (const Sample& s : samples) {
    const double angle = 4.0 * std::atan2(s.n.y(), s.n.x());
    turn += s.n.head<2>().squaredNorm() * Vec2(std::cos(angle), std::sin(angle));
  }
  box.turn_to(0.25 * std::atan2(turn.y(), turn.x()));
  const double width = 2.0 * kOffSigmas * mean_sigma(samples);
  for (int round = 0; round < kFitRounds; ++round) {
    if (round > 0) box.turn_to(box.yaw + turn_asked(box, samples));
    std::array<std::vector<double>, 5> places;
    for (const Sample& s : samples) {
      const int k = box.side(s.n);
      places[k].push_back(box.place(k, s.p));
    }
    for (int k = 0; k < 5; ++k) {
      box.ends[k] = static_cast<double>(places[k].size()) > kSeen * static_cast<double>(samples.size());
      if (!places[k].empty()) box.at[k] = mode(std::move(places[k]), width);
    }
  }
  return box;
}

/// The plane that most of some samples lie on, which look the same way.
Plane plane_of_most(std::span<const Sample> samples) {
  Vec3 normal = Vec3::Zero();
  for (const Sample& s : samples) normal += s.n;
  normal.normalize();
  std::vector<double> heights;
  for (const Sample& s : samples) heights.push_back(normal.dot(s.p));
  Plane plane{normal, mode(std::move(heights), 2.0 * kOffSigmas * mean_sigma(samples))};
  const Vec3 origin = samples.front().p;
  for (int round = 0; round < kFitRounds; ++round) {
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    double count = 0;
    for (const Sample& s : samples) {
      if (std::abs(plane.signed_distance(s.p)) > kOffSigmas * s.sigma) continue;
      first += s.p - origin;
      second += (s.p - origin) * (s.p - origin).transpose();
      count += 1.0;
    }
    if (count < 3.0) break;
    const Vec3 mean = first / count;
    const Vec3 fitted = symmetric_eigen<3>(second / count - mean * mean.transpose()).vectors.col(0);
    plane = {fitted, fitted.dot(origin + mean)};
  }
  return plane;
}

}  // namespace

double unexplained(std::span<const Sample> samples) {
  if (samples.empty()) return 0.0;
  const UprightBox box = fit_upright(samples);
  double sum = 0;
  for (const Sample& s : samples) {
    const double off = box.off(s);
    sum += box.holds(s) ? std::min(off * off, 1.0) : 1.0;
  }
  return sum;
}

Vec2 across_front(std::span<const Sample> samples) {
  const UprightBox box = fit_upright(samples);
  std::array<int, 5> count{};
  for (const Sample& s : samples) ++count[box.side(s.n)];
  const Vec2 out = box.out[std::max_element(count.begin(), count.begin() + 4) - count.begin()];
  return {-out.y(), out.x()};
}

double unexplained_leaning(std::span<const Sample> samples) {
  if (samples.empty()) return 0.0;
  const UprightBox box = fit_upright(samples);
  std::array<std::vector<Sample>, 5> sides;
  for (const Sample& s : samples) sides[box.side(s.n)].push_back(s);
  double sum = 0;
  for (const std::vector<Sample>& side : sides) {
    if (side.empty()) continue;
    const Plane plane = plane_of_most(side);
    for (const Sample& s : side) sum += std::min(std::pow(plane.signed_distance(s.p) / (kOffSigmas * s.sigma), 2), 1.0);
  }
  return sum;
}

}  // namespace unseen::cuboids
