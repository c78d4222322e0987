// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/stack_levels.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace unseen::cuboids {
namespace {

constexpr std::size_t kCoarse = 400, kFine = 2000;  // samples of a part: to see whether it is a stack, and to place its levels
constexpr std::size_t kFewestSamples = 24;  // on either side of a level
constexpr double kSmallestShare = 0.06;   // of the samples, on either side of a level
constexpr int kFirstLevels = 20, kFinerLevels = 4;
constexpr double kOffSigmas = 3.0;      // a point farther off its side counts as unexplained
constexpr double kLeastExplained = 0.08;  // of the points, that a level must explain more …
constexpr double kLeastShare = 0.2;      // … and of those that one box leaves unexplained
constexpr double kMostLeft = 0.25;      // of the points, that may stay unexplained …
constexpr double kMostOfOne = 0.5;      // … and of those that one box leaves so
constexpr double kLeastHeight = 0.02, kLeastHeightSigmas = 10.0;  // m, of what stands on or under another
constexpr double kFacesUp = 0.7;
constexpr int kRounds = 3;
constexpr double kSeen = 0.03;  // of the samples, of a side that was seen
constexpr double kFar = 1e9;

/// A point of a part, and where its surface looks.
struct Sample {
  Vec3 p, n;
  double sigma;
};

/// Middle of the window of a given width that holds most values.
double mode(std::vector<double>& values, double width) {
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

/// An upright box with one side each way, as far as they were seen.
struct UprightBox {
  double yaw = 0;
  std::array<double, 5> at{};  ///< m, of the four sides and the top along their normals; infinite = not seen
  std::array<char, 5> ends{};  ///< whether enough was seen of a side to say that the box ends there

  Vec2 out(int k) const { return {std::cos(yaw + 0.5 * kPi * k), std::sin(yaw + 0.5 * kPi * k)}; }
  double place(int k, const Vec3& p) const { return k == 4 ? p.z() : out(k).dot(p.head<2>()); }
  int side(const Vec3& normal) const {
    if (normal.z() > kFacesUp) return 4;
    int best = 0;
    for (int k = 1; k < 4; ++k)
      if (out(k).dot(normal.head<2>()) > out(best).dot(normal.head<2>())) best = k;
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
    const Vec2 out = box.out(k);
    const double along = -out.y() * s.p.x() + out.x() * s.p.y(), off = box.place(k, s.p) - box.at[k];
    const std::array<double, 5> terms{1.0, along, off, along * along, along * off};
    for (int t = 0; t < 5; ++t) sums[k][t] += terms[t];
  }
  double numerator = 0, denominator = 1e-12;
  for (const auto& [count, along, off, square, product] : sums)
    if (count > 2.0) numerator += product - along * off / count, denominator += square - along * along / count;
  return -numerator / denominator;
}

/// The upright box that explains most samples: turned as their normals say, then as their places do.
UprightBox fit_upright(std::span<const Sample> samples) {
  UprightBox box;
  Vec2 turn = Vec2::Zero();
  double sigma = 0;
  for (const Sample& s : samples) {
    const double angle = 4.0 * std::atan2(s.n.y(), s.n.x());
    turn += s.n.head<2>().squaredNorm() * Vec2(std::cos(angle), std::sin(angle));
    sigma += s.sigma / static_cast<double>(samples.size());
  }
  box.yaw = 0.25 * std::atan2(turn.y(), turn.x());
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) box.yaw += turn_asked(box, samples);
    std::array<std::vector<double>, 5> places;
    for (const Sample& s : samples) {
      const int k = box.side(s.n);
      places[k].push_back(box.place(k, s.p));
    }
    for (int k = 0; k < 5; ++k) {
      box.ends[k] = static_cast<double>(places[k].size()) > kSeen * static_cast<double>(samples.size());
      box.at[k] = places[k].empty() ? std::numeric_limits<double>::infinity() : mode(places[k], 2.0 * kOffSigmas * sigma);
    }
  }
  return box;
}

/// How much of the samples (each 0 … 1) no upright box explains.
double unexplained(std::span<const Sample> samples) {
  const UprightBox box = fit_upright(samples);
  double cost = 0;
  for (const Sample& s : samples) cost += box.holds(s) ? std::min(box.off(s) * box.off(s), 1.0) : 1.0;
  return cost;
}

/// The same of a body whose sides may lean: one plane each way.
double unexplained_leaning(std::span<const Sample> samples) {
  const UprightBox box = fit_upright(samples);
  std::array<std::vector<const Sample*>, 5> sides;
  for (const Sample& s : samples) sides[box.side(s.n)].push_back(&s);
  double cost = 0;
  for (const std::vector<const Sample*>& side : sides) {
    if (side.empty()) continue;
    Vec3 normal = Vec3::Zero();
    for (const Sample* s : side) normal += s->n;
    normal.normalize();
    std::vector<double> heights;
    for (const Sample* s : side) heights.push_back(normal.dot(s->p));
    double offset = mode(heights, 2.0 * kOffSigmas * side.front()->sigma);
    for (int round = 0; round < kRounds; ++round) {
      Vec3 first = Vec3::Zero();
      Mat3 second = Mat3::Zero();
      double count = 0;
      for (const Sample* s : side) {
        if (std::abs(normal.dot(s->p) - offset) > kOffSigmas * s->sigma) continue;
        const Vec3 d = s->p - side.front()->p;
        first += d;
        second += d * d.transpose();
        count += 1.0;
      }
      if (count < 3.0) break;
      const Vec3 mean = first / count;
      const Vec3 fitted = Eigen::SelfAdjointEigenSolver<Mat3>(second / count - mean * mean.transpose()).eigenvectors().col(0);
      normal = fitted.dot(normal) < 0.0 ? Vec3(-fitted) : fitted;
      offset = normal.dot(side.front()->p + mean);
    }
    for (const Sample* s : side) cost += std::min(std::pow((normal.dot(s->p) - offset) / (kOffSigmas * s->sigma), 2), 1.0);
  }
  return cost;
}

/// The level that two boxes explain most above and below; none if one box does nearly as well.
struct Level {
  double z = 0, left = std::numeric_limits<double>::infinity();
};

Level best_level(std::span<const Sample> samples) {  // in order of height
  const double low = samples.front().p.z(), high = samples.back().p.z(), step = (high - low) / kFirstLevels;
  const std::size_t fewest = std::max(kFewestSamples, static_cast<std::size_t>(kSmallestShare * static_cast<double>(samples.size())));
  const double height = std::max(kLeastHeight, kLeastHeightSigmas * samples.front().sigma);
  Level best;
  const auto attempt = [&](double z) {
    if (z - low < height || high - z < height) return;
    const auto from = std::lower_bound(samples.begin(), samples.end(), z, [](const Sample& s, double value) { return s.p.z() < value; });
    const auto below = static_cast<std::size_t>(from - samples.begin());
    if (below < fewest || samples.size() - below < fewest) return;
    const double left = unexplained(samples.first(below)) + unexplained(samples.subspan(below));
    if (left < best.left) best = {z, left};
  };
  for (int k = 1; k < kFirstLevels; ++k) attempt(low + step * k);
  return best;
}

std::span<const Sample> between(std::span<const Sample> samples, double low, double high) {
  const auto lower = [&](double z) { return std::lower_bound(samples.begin(), samples.end(), z, [](const Sample& s, double value) { return s.p.z() < value; }); };
  return {lower(low), lower(high)};
}

/// Levels that cut some samples into boxes, from below.
std::vector<double> split(std::span<const Sample> samples) {
  const double count = static_cast<double>(samples.size()), one = unexplained(samples);
  if (samples.size() < 2 * kFewestSamples || one < kLeastExplained * count) return {};
  const Level level = best_level(samples);
  if (one - level.left < std::max(kLeastExplained * count, kLeastShare * one)) return {};
  std::vector<double> levels = split(between(samples, -kFar, level.z));
  levels.push_back(level.z);
  const std::vector<double> above = split(between(samples, level.z, kFar));
  levels.insert(levels.end(), above.begin(), above.end());
  return levels;
}

/// Moves each level to where the boxes on either side explain most.
void place(std::vector<double>& levels, std::span<const Sample> samples) {
  double step = (samples.back().p.z() - samples.front().p.z()) / kFirstLevels;
  for (int round = 0; round < 3; ++round) {
    step /= kFinerLevels;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const double low = k > 0 ? levels[k - 1] : -kFar, high = k + 1 < levels.size() ? levels[k + 1] : kFar, middle = levels[k];
      double least = std::numeric_limits<double>::infinity();
      for (int move = -kFinerLevels; move <= kFinerLevels; ++move) {
        const double z = middle + step * move;
        const auto below = between(samples, low, z), above = between(samples, z, high);
        if (z <= low || z >= high || below.empty() || above.empty()) continue;
        if (const double left = unexplained(below) + unexplained(above); left < least) least = left, levels[k] = z;
      }
    }
  }
}

/// The levels between which a stack's boxes are; none if it is not much better explained so than by one box.
std::vector<double> levels_of(std::span<const Sample> samples) {
  std::vector<double> levels = split(samples);
  if (levels.empty()) return {};
  place(levels, samples);
  // The first cuts of a tower may lie within a box: whatever one box between the next levels explains as well is one.
  levels.insert(levels.begin(), -kFar);
  levels.push_back(kFar);
  for (std::size_t k = 1; k + 1 < levels.size();) {
    const auto below = between(samples, levels[k - 1], levels[k]), above = between(samples, levels[k], levels[k + 1]);
    const auto both = between(samples, levels[k - 1], levels[k + 1]);
    const double gain = unexplained(both) - unexplained(below) - unexplained(above);
    if (gain < kLeastExplained * static_cast<double>(both.size())) levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(k));
    else ++k;
  }
  double left = 0;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) left += unexplained(between(samples, levels[k], levels[k + 1]));
  if (left > std::min(kMostLeft * static_cast<double>(samples.size()), kMostOfOne * std::min(unexplained(samples), unexplained_leaning(samples)))) return {};
  return {levels.begin() + 1, levels.end() - 1};
}

std::vector<Sample> samples_of(const Observation& seen, const std::vector<int>& points, std::size_t most) {
  std::vector<Sample> samples;
  const std::size_t step = points.size() / most + 1;
  for (std::size_t k = 0; k < points.size(); k += step)
    if (const int i = points[k]; !seen.graph.normals[i].isZero()) samples.push_back({seen.points[i], seen.graph.normals[i], seen.graph.sigma[i]});
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.p.z() < b.p.z(); });
  return samples;
}

}  // namespace

Stacks find_stacks(const Observation& seen, const std::vector<std::vector<int>>& parts) {
  Stacks stacks{std::vector<int>(seen.points.size(), 0), {-1}};
  int stack = 0;
  for (const std::vector<int>& part : parts) {
    std::vector<double> levels = levels_of(samples_of(seen, part, kCoarse));
    if (levels.empty()) continue;
    place(levels, samples_of(seen, part, kFine));
    const auto first = static_cast<int>(stacks.stack_of_piece.size());
    for (const int i : part)
      stacks.piece_of_point[i] = first + static_cast<int>(std::upper_bound(levels.begin(), levels.end(), seen.points[i].z()) - levels.begin());
    stacks.stack_of_piece.resize(stacks.stack_of_piece.size() + levels.size() + 1, stack++);
  }
  return stacks;
}

}  // namespace unseen::cuboids
