// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/which_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "collision/orientations/pose_cost.h"
#include "collision/orientations/views.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr int kViews = 1000;
constexpr std::size_t kLooks = 8;        // of a flight
constexpr double kSpur = 0.03;           // of the outline's size
constexpr double kOutlineNoise = 0.7;    // px
constexpr double kShapeNoise = 0.012;    // of the outline's size: views that are left out, perspective
constexpr double kIndependent = 10.0;    // directions
constexpr double kMostSquares = 60.0;    // χ² of one outline
constexpr double kDistanceNoise = 0.03;  // share, of one outline
constexpr double kAlike = 12.0;          // χ² by which a side is worse than the best that goes with an outline as well
constexpr int kRounds = 5;
constexpr double kClear = 20.0;          // χ² that tell the bodies apart

/// A plane figure by its support about its centroid, both in units of the root of its area.
struct Outline {
  Support reach = Support::Zero();
  double size = 0;  ///< root of the area: px of a region, m of a body
};

std::optional<Outline> outline_of(const std::vector<Vec2>& corners) {
  std::vector<cv::Point2f> points;
  for (const Vec2& c : corners) points.emplace_back(static_cast<float>(c.x()), static_cast<float>(c.y()));
  if (points.size() < 3) return std::nullopt;
  const cv::Moments m = cv::moments(points);
  if (std::abs(m.m00) <= 0.0) return std::nullopt;
  Outline outline;
  outline.size = std::sqrt(std::abs(m.m00));
  Eigen::Matrix2Xd places(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) places.col(static_cast<Eigen::Index>(i)) = corners[i];
  outline.reach = support_of(places, {m.m10 / m.m00, m.m01 / m.m00}) / outline.size;
  return outline;
}

/// A body from all sides, from afar; lengths in thousandths of a metre while the corners are floats.
std::vector<Outline> outlines_of(const Body& body, const std::string& source) {
  if (body.shape == Shape::sphere) return {{Support::Constant(1.0 / std::sqrt(kPi)), body.radius * std::sqrt(kPi)}};
  constexpr double kUnit = 1e-3;
  const SpinBody spin = spin_body(body, source);
  std::vector<Outline> all;
  for (const Vec3& view : sphere_directions(kViews)) {
    const Eigen::Matrix3Xd turned = turn_between(view, Vec3::UnitZ()).toRotationMatrix() * spin.corners / kUnit;
    std::vector<cv::Point2f> points, hull;
    for (const auto& c : turned.colwise()) points.emplace_back(static_cast<float>(c.x()), static_cast<float>(c.y()));
    cv::convexHull(points, hull);
    std::vector<Vec2> corners;
    for (const cv::Point2f& p : hull) corners.push_back({p.x, p.y});
    if (auto outline = outline_of(corners)) {
      outline->size *= kUnit;
      all.push_back(*outline);
    }
  }
  return all;
}

/// A body from one side as what was seen: how well it goes with it, and the distance that follows.
struct View {
  double cost = 0, log_distance = 0;
};

/// The sides of a body that go with one outline about as well as the best; it comes first.
struct Match {
  double time = 0;
  std::vector<View> views;
};

Match match(const Outline& seen, double time, const std::vector<Outline>& body, double focal) {
  const double noise = std::hypot(kOutlineNoise / seen.size, kShapeNoise), unit = kIndependent / kDirections / (noise * noise);
  Match match{time, {}};
  double least = std::numeric_limits<double>::infinity();
  for (const Outline& o : body) {
    double cost = std::numeric_limits<double>::infinity();
    for (int shift = 0; shift < kDirections; ++shift) {
      double sum = 0.0;
      for (int i = 0; i < kDirections && sum * unit < std::min(cost, least + kAlike); ++i) sum += std::pow(o.reach[(i + shift) % kDirections] - seen.reach[i], 2);
      cost = std::min(cost, sum * unit);
    }
    if (cost >= least + kAlike) continue;
    match.views.push_back({std::min(cost, kMostSquares), std::log(focal * o.size / seen.size)});
    least = std::min(least, cost);
  }
  std::erase_if(match.views, [&](const View& v) { return v.cost > std::min(least, kMostSquares) + kAlike; });
  std::sort(match.views.begin(), match.views.end(), [](const View& x, const View& y) { return x.cost < y.cost; });
  return match;
}

/// A flight as one body: χ² of its outlines and of its distances about a line, and the logarithm of the distance at a time.
struct FlightMatch {
  double cost = std::numeric_limits<double>::infinity(), log_distance = 0;
};

/// Among sides that look alike those count whose distances change evenly: a box from another side may be as broad, and nearer.
FlightMatch along(const std::vector<Match>& matches, double time) {
  FlightMatch best;
  for (const Match& start : matches) {
    Eigen::Vector2d line(start.views.front().log_distance, 0.0);
    FlightMatch flight;
    for (int round = 0; round < kRounds; ++round) {
      Eigen::Matrix2d normal = Eigen::Vector2d(0.0, 1e-6).asDiagonal();
      Eigen::Vector2d right = Eigen::Vector2d::Zero();
      flight = {0.0, line[0]};
      for (const Match& m : matches) {
        const Eigen::Vector2d row(1.0, m.time - time);
        double least = std::numeric_limits<double>::infinity(), distance = 0.0;
        for (const View& v : m.views)
          if (const double cost = v.cost + std::pow((v.log_distance - row.dot(line)) / kDistanceNoise, 2); cost < least) least = cost, distance = v.log_distance;
        normal += row * row.transpose();
        right += row * distance;
        flight.cost += std::min(2.0 * kMostSquares, least);
      }
      line = normal.inverse() * right;
    }
    if (flight.cost < best.cost) best = flight;
  }
  return best;
}

/// Outlines of a flight, spread over it, with their times.
std::vector<std::pair<double, Outline>> seen_along(const Footage& footage, const Tracks& tracks, const FlightSpan& span) {
  std::vector<std::pair<double, Outline>> all;
  const std::size_t count = span.end - span.begin, wanted = std::min(kLooks, count);
  for (std::size_t i = 0; i < wanted; ++i) {
    const TrackPoint& point = tracks.points[span.begin + (2 * i + 1) * count / (2 * wanted)];
    if (point.region < 0) continue;
    const Region& region = footage.regions[static_cast<std::size_t>(point.frame)][static_cast<std::size_t>(point.region)];
    if (region.at_border || region.clipped || region.mask.empty()) continue;
    if (const auto outline = outline_of(mask_outline(region.mask, kSpur * std::sqrt(region.area)))) all.emplace_back(point.time, *outline);
  }
  return all;
}

}  // namespace

void label_by_shape(const Shot& shot, const ShotCamera& camera, const Footage& footage, Tracks& tracks) {
  const auto known = [](const Body& b) { return b.shape == Shape::sphere || b.shape == Shape::box || b.shape == Shape::mesh; };
  const auto& bodies = shot.bodies;
  if (tracks.meetings.empty() || !known(bodies[0]) || !known(bodies[1])) return;
  if (bodies[0].shape == Shape::sphere && bodies[1].shape == Shape::sphere) return;
  const double focal = std::sqrt(camera.camera.fx * camera.camera.fy);
  const std::array<std::vector<Outline>, 2> shapes = {outlines_of(bodies[0], shot.name), outlines_of(bodies[1], shot.name)};
  const Tracks::Meeting& meeting = tracks.meetings.front();
  std::array<double, 2> cost = {0.0, 0.0};  // as labelled, exchanged
  for (const std::vector<int>* side : {&meeting.before, &meeting.after}) {
    std::array<std::array<double, 2>, 2> distance{};  // [exchanged][body]
    for (const int s : *side) {
      const FlightSpan& span = tracks.spans[static_cast<std::size_t>(s)];
      const auto seen = seen_along(footage, tracks, span);
      if (seen.size() < 2) return;
      for (const int exchanged : {0, 1}) {
        const auto body = static_cast<std::size_t>(exchanged ? 1 - span.body : span.body);
        std::vector<Match> matches;
        for (const auto& [time, outline] : seen) matches.push_back(match(outline, time, shapes[body], focal));
        const FlightMatch flight = along(matches, meeting.time);
        cost[static_cast<std::size_t>(exchanged)] += flight.cost;
        distance[static_cast<std::size_t>(exchanged)][body] = flight.log_distance;
      }
    }
    for (const std::size_t exchanged : {0u, 1u}) {
      const auto& d = distance[exchanged];
      double reach = 0.0;
      for (const auto& shape : shapes) reach += 0.5 * std::max_element(shape.begin(), shape.end(), [](auto& a, auto& b) { return a.size < b.size; })->size;
      const double slack = std::hypot(kDistanceNoise, reach / std::exp(0.5 * (d[0] + d[1])));
      cost[exchanged] += std::min(kMostSquares, std::pow((d[0] - d[1]) / slack, 2));
    }
  }
  tracks.told_apart = std::abs(cost[0] - cost[1]) > kClear;
  if (cost[1] >= cost[0] || !tracks.told_apart) return;
  exchange_bodies(tracks);
}

}  // namespace unseen::collision
