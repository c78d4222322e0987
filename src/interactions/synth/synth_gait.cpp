// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_gait.h"

#include <algorithm>

namespace unseen::interactions {
namespace {

constexpr double kGaitStep = 1.0 / kRate;  // s

struct Place {
  Vec2 at = Vec2::Zero();
  double heading = 0;
  double speed = 0;
};

double wrapped(double angle) { return std::remainder(angle, 2.0 * kPi); }

/// Running means; ends stay.
std::vector<double> averaged(const std::vector<double>& values, int radius) {
  std::vector<double> sums = {0.0};
  for (const double v : values) sums.push_back(sums.back() + v);
  std::vector<double> result;
  const int last = static_cast<int>(values.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const int r = std::min({radius, i, last - i});
    result.push_back((sums[static_cast<std::size_t>(i + r + 1)] - sums[static_cast<std::size_t>(i - r)]) / (2 * r + 1));
  }
  return result;
}

/// Nobody turns a corner at once.
void round_off(std::vector<Place>& places) {
  for (const int axis : {0, 1}) {
    std::vector<double> values;
    for (const Place& p : places) values.push_back(p.at[axis]);
    values = averaged(averaged(values, 9), 6);
    for (std::size_t k = 0; k < places.size(); ++k) places[k].at[axis] = values[k];
  }
}

/// Where the trunk is at each moment: slow where it turns, no faster than it can stop.
std::vector<Place> stroll(const std::vector<Vec2>& path, double heading, double final_heading, const Manner& manner) {
  std::vector<double> length = {0.0};
  for (std::size_t i = 1; i < path.size(); ++i) length.push_back(length.back() + (path[i] - path[i - 1]).norm());
  const auto point = [&](double s) -> Vec2 {
    const auto after = std::upper_bound(length.begin() + 1, length.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - length.begin());
    const double part = length[i] - length[i - 1];
    return path[i - 1] + (part > 0 ? std::clamp((s - length[i - 1]) / part, 0.0, 1.0) : 0.0) * (path[i] - path[i - 1]);
  };
  const double total = length.back(), acceleration = 0.9 * manner.lively;
  std::vector<Place> places;
  double s = 0, speed = 0, turning = 0;
  for (int k = 0; k < static_cast<int>(120 * kRate); ++k) {
    const double rest = total - s;
    const Vec2 look = point(std::min(total, s + 0.45)) - point(s);
    const bool arriving = rest < 0.25 || look.norm() < 0.02;
    const double wanted = arriving ? final_heading : std::atan2(-look.x(), look.y());
    const double error = wrapped(wanted - heading);
    // a turn speeds up and brakes softly
    const double rate = std::clamp(4.5 * error, -2.4, 2.4) * manner.lively;
    turning += std::clamp(rate - turning, -12.0 * kGaitStep, 12.0 * kGaitStep);
    heading += turning * kGaitStep;
    const double free = arriving ? std::max(0.3, std::cos(error)) : std::max(0.05, std::cos(std::min(1.2 * std::abs(error), 0.5 * kPi)));
    const double allowed = std::min(manner.speed * free, std::sqrt(2.0 * 0.8 * acceleration * std::max(0.0, rest)));
    speed += std::clamp(allowed - speed, -2.5 * kGaitStep, acceleration * kGaitStep);
    s = std::min(total, s + speed * kGaitStep);
    places.push_back({point(s), heading, speed});
    if (rest < 2e-4 && std::abs(error) < 1e-3 && std::abs(turning) < 0.01) break;
  }
  places.insert(places.end(), 16, {path.back(), heading + wrapped(final_heading - heading), 0.0});  // time to come to rest
  round_off(places);
  return places;
}

/// Feet are closer together in walking than in standing, where one is a little ahead (`stagger`, m).
Vec3 footprint(const Body& body, const Place& place, double stagger, int side) {
  const double slow = 1.0 - std::min(1.0, place.speed / 0.5);
  return Vec3(place.at.x(), place.at.y(), body.ankle) + outward(side) * (0.8 + 0.3 * slow) * body.hip * rightward(place.heading) +
         0.5 * outward(side) * slow * stagger * ahead(place.heading);
}

/// Feet take turns; each is put down where the trunk will be in the middle of the time for which it stands there.
std::vector<std::array<Vec3, 2>> step(std::vector<Place>& places, const Body& body, double stagger, std::array<Vec3, 2> feet) {
  const auto at = [&](std::size_t k) -> const Place& { return places[std::min(k, places.size() - 1)]; };
  std::vector<std::array<Vec3, 2>> track;
  int side = (footprint(body, at(30), stagger, kRight) - feet[kRight]).norm() > (footprint(body, at(30), stagger, kLeft) - feet[kLeft]).norm() ? kRight : kLeft;
  for (int idle = 0; idle < 3;) {
    const double cadence = 0.64 - 0.10 * at(track.size() + 15).speed * std::sqrt(1.7 / body.height);
    const auto frames = static_cast<std::size_t>(cadence * kRate);
    const Vec3 target = footprint(body, at(track.size() + frames + frames / 2), stagger, side), start = feet[static_cast<std::size_t>(side)];
    const double distance = (target - start).norm();
    const Place& here = at(track.size());
    const bool ended = (here.at - places.back().at).norm() < 0.02 && std::abs(here.heading - places.back().heading) < 0.05;
    if (distance < (ended ? 0.02 : 0.05)) {  // stays
      if (ended) {
        ++idle;
      } else {
        for (std::size_t k = 0; k < frames / 3; ++k) track.push_back(feet);
      }
      side = 1 - side;
      continue;
    }
    idle = 0;
    for (std::size_t k = 1; k <= frames; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(frames);
      const double height = (0.05 + 0.07 * std::min(1.0, distance / 0.8)) * std::sin(kPi * std::pow(u, 0.75));  // heel first
      feet[static_cast<std::size_t>(side)] = start + ease(u) * (target - start) + std::max(0.0, height) * Vec3::UnitZ();
      track.push_back(feet);
    }
    feet[static_cast<std::size_t>(side)] = target;
    side = 1 - side;
  }
  track.insert(track.end(), 14, feet);  // the weight settles
  while (places.size() < track.size()) places.push_back(places.back());
  places.resize(track.size());  // the rest is only standing
  return track;
}

/// As high as both legs allow, over every moment, so that the pelvis dips where steps are long.
std::vector<double> pelvis_heights(const Body& body, const std::vector<Place>& places, const std::vector<std::array<Vec3, 2>>& feet) {
  constexpr int kRadius = 5;
  std::vector<double> highest;
  for (std::size_t k = 0; k < places.size(); ++k) {
    double z = body.standing();
    for (const int side : {kRight, kLeft}) {
      const Vec2 hip = places[k].at + (outward(side) * body.hip * rightward(places[k].heading)).head<2>();
      const Vec3& foot = feet[k][static_cast<std::size_t>(side)];
      const double across = (foot.head<2>() - hip).squaredNorm(), leg = kStraight * body.leg();
      z = std::min(z, foot.z() + std::sqrt(std::max(0.3 * leg * leg, leg * leg - across)));
    }
    highest.push_back(z);
  }
  std::vector<double> least;
  const int last = static_cast<int>(highest.size()) - 1;
  for (int i = 0; i <= last; ++i)
    least.push_back(*std::min_element(highest.begin() + std::max(0, i - kRadius), highest.begin() + std::min(last, i + kRadius) + 1));
  return averaged(least, kRadius);
}

}  // namespace

double ease(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

Manner draw_manner(Random& random) {
  Manner m;
  m.speed = random.uniform(0.75, 1.35);
  m.swing = random.uniform(0.35, 0.8);
  m.stoop = random.uniform(0.0, 0.14);
  m.bend = random.uniform(0.2, 0.7);
  m.lively = random.uniform(0.8, 1.25);
  m.phase = random.uniform(0.0, 2.0 * kPi);
  return m;
}

void walk(Motion& motion, const Body& body, const Manner& manner, const std::vector<Vec2>& path, double final_heading) {
  const Posture start = motion.back().posture;
  std::vector<Place> places = stroll(path, heading(start.hips), final_heading, manner);
  const std::vector<std::array<Vec3, 2>> feet = step(places, body, 0.08 * std::sin(manner.phase + static_cast<double>(path.size())), start.feet);
  const std::vector<double> heights = pelvis_heights(body, places, feet);
  std::vector<double> sway, stride, lean, turn;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Vec3 forward = ahead(places[k].heading);
    sway.push_back(feet[k][kRight].z() > feet[k][kLeft].z() ? -1.0 : feet[k][kLeft].z() > feet[k][kRight].z() ? 1.0 : 0.0);
    stride.push_back((feet[k][kLeft] - feet[k][kRight]).dot(forward));
    lean.push_back(manner.stoop + 0.05 * places[k].speed);
    const Place& later = places[std::min(k + 20, places.size() - 1)];
    turn.push_back(std::clamp(1.2 * (later.heading - places[k].heading), -0.6, 0.6));  // the head turns first
  }
  sway = averaged(averaged(sway, 10), 8);
  stride = averaged(stride, 4);
  lean = averaged(lean, 12);
  turn = averaged(turn, 10);
  Motion walked;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Turn upright = about_z(places[k].heading);
    Moment m;
    Posture& p = m.posture;
    p.pelvis = Vec3(places[k].at.x(), places[k].at.y(), heights[k]) + 0.02 * sway[k] * rightward(places[k].heading);
    p.hips = upright * about_z(-0.14 * stride[k]) * about_y(0.03 * sway[k]);
    p.chest = upright * about_z(0.16 * stride[k]) * about_x(-lean[k]) * about_y(-0.02 * sway[k]);
    p.head = upright * about_z(turn[k]) * about_x(-0.5 * lean[k]);
    p.feet = feet[k];
    for (const int side : {kRight, kLeft}) {
      const double forward = outward(side) * stride[k];  // against the foot of that side
      p.hands[side] = hanging_hand(body, p, side, 0.03 + manner.swing * forward,
                                   manner.bend + 0.15 * places[k].speed + 0.2 * std::max(0.0, forward));
    }
    if (manner.carrying >= 0)
      p.hands[static_cast<std::size_t>(manner.carrying)] = p.pelvis + p.chest * Vec3(outward(manner.carrying) * 0.06, 0.27, 0.5 * body.trunk);
    const bool stepping = std::max(feet[k][kRight].z(), feet[k][kLeft].z()) > body.ankle + 0.01;
    m.action = stepping || places[k].speed > 0.15 ? Action::walk : Action::stand;
    walked.push_back(m);
  }
  // how the trunk and the arms were before fades out, seen from the body
  const Posture first = walked.front().posture;
  const Turn to_own = about_z(-heading(start.hips));
  const auto fade = [](const Turn& was, const Turn& is, double share, const Turn& now) { return now * Turn::Identity().slerp(share, is.inverse() * was); };
  for (std::size_t k = 0; k < walked.size(); ++k) {
    Posture& p = walked[k].posture;
    const double share = 1.0 - ease(static_cast<double>(k) / (0.8 * kRate));
    if (share <= 0) break;
    const Turn turned = about_z(places[k].heading) * to_own;
    p.pelvis += share * (turned * (start.pelvis - first.pelvis));
    p.hips = fade(start.hips, first.hips, share, p.hips);
    p.chest = fade(start.chest, first.chest, share, p.chest);
    p.head = fade(start.head, first.head, share, p.head);
    for (const int side : {kRight, kLeft}) p.hands[side] += share * (turned * ((start.hands[side] - start.pelvis) - (first.hands[side] - first.pelvis)));
  }
  motion.insert(motion.end(), walked.begin(), walked.end());
}

}  // namespace unseen::interactions
