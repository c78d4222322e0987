// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/spin_search.h"

#include <algorithm>

#include "collision/orientations/pose_candidates.h"
#include "collision/solve/rotation.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kPoses = 16;       // candidates a frame
constexpr std::size_t kPlaces = 4;       // of a flight where the search starts
constexpr double kFastest = 60.0;        // rad/s
constexpr std::size_t kSeeds = 120;      // pairs that are refined, at each place
constexpr std::size_t kBeam = 40;        // of those that are followed
constexpr int kStepsInGrowth = 5;        // of each refinement while the window grows
constexpr std::size_t kSwapped = 4;      // motions, the best ones, that are tried with the body put the other way round
constexpr double kAlike = 0.12;          // rad, at both ends of the flight

bool better(const Turning& a, const Turning& b) { return a.cost < b.cost; }

}  // namespace

void keep_best(std::vector<Turning>& all, const SpinBody& body, double from, double to, std::size_t count) {
  const double slack = 2.0 * kAlike * body.solid.mass.inertia.maxCoeff() / std::max(to - from, 1e-3);
  std::stable_sort(all.begin(), all.end(), better);
  std::vector<Turning> kept;
  std::vector<std::pair<Quat, Quat>> ends;
  for (const Turning& t : all) {
    if (kept.size() >= count) break;
    const Quat first = at_time(t, body, from).q, last = at_time(t, body, to).q;
    bool known = false;
    for (std::size_t i = 0; i < kept.size() && !known; ++i)
      known = (t.h - kept[i].h).norm() < std::max(slack, 0.1 * t.h.norm()) &&
              angle_between(first, ends[i].first, body.symmetry.turns) < kAlike &&
              angle_between(last, ends[i].second, body.symmetry.turns) < kAlike;
    if (known) continue;
    kept.push_back(t);
    ends.emplace_back(first, last);
  }
  all = std::move(kept);
}

namespace {

/// Motions that join a pose of one look with one of the next, the short way or once around the long way.
std::vector<Turning> pairs(const SpinBody& body, const std::vector<Look>& looks, std::size_t at, const std::vector<PoseCandidate>& first,
                           const std::vector<PoseCandidate>& second) {
  const double dt = looks[at + 1].time - looks[at].time;
  std::vector<Turning> all;
  for (const PoseCandidate& a : first)
    for (const PoseCandidate& b : second)
      for (const Quat& g : body.symmetry.turns) {
        const Vec3 turn = rotation_vector<double>(b.q * g * a.q.conjugate());
        const double angle = std::max(turn.norm(), 1e-9);
        for (const double whole : {0.0, 2.0 * kPi}) {
          const Vec3 omega = turn * ((angle - whole) / angle / dt);
          if (omega.norm() > kFastest) continue;
          Turning t;
          t.time = 0.5 * (looks[at].time + looks[at + 1].time);
          t.q = rotation_by<double>(Vec3(0.5 * dt * omega)) * a.q;
          t.h = t.q * body.solid.mass.inertia.cwiseProduct(t.q.conjugate() * omega);
          t.cost = a.cost + b.cost;
          all.push_back(t);
        }
      }
  return all;
}

/// Follows the best motions of two neighbouring looks to the ends of the flight, through windows that grow.
std::vector<Turning> grown(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t at) {
  const std::vector<PoseCandidate> first = pose_candidates(body, camera, looks[at], kPoses);
  const std::vector<PoseCandidate> second = pose_candidates(body, camera, looks[at + 1], kPoses);
  std::vector<Turning> beam = pairs(body, looks, at, first, second);
  std::size_t begin = at, end = at + 2, count = kBeam;
  bool seeds = true;
  while (true) {
    const std::size_t more = std::max<std::size_t>(1, (end - begin) / 3);
    begin -= std::min(begin, more);
    end = std::min(looks.size(), end + more);
    const double from = looks[begin].time, to = looks[end - 1].time;
    if (seeds) {
      for (Turning& t : beam) t.cost = silhouette_cost(t, body, camera, looks, begin, end);
      keep_best(beam, body, from, to, kSeeds);
    }
    seeds = false;
    for (Turning& t : beam) t = refined(t, body, camera, looks, begin, end, kStepsInGrowth);
    keep_best(beam, body, from, to, count);
    if (begin == 0 && end == looks.size()) return beam;
    count = std::max<std::size_t>(12, 2 * count / 3);
  }
}

/// The motion seen in a mirror behind the body, across the view ray; only bodies with a reflection of their own have one.
std::vector<Turning> mirrored(const Turning& t, const SpinBody& body, const std::vector<Look>& looks) {
  if (body.symmetry.reflections.empty()) return {};
  const Vec3 ray = looks[looks.size() / 2].center.normalized();
  const Mat3 mirror = Mat3::Identity() - 2.0 * ray * ray.transpose();
  Turning m = t;
  m.q = Quat(Mat3(mirror * t.q.toRotationMatrix() * body.symmetry.reflections.front()));
  m.h = -(mirror * t.h);  // a pseudovector
  return {m};
}

/// The motion of the body put the other way round, where it looks nearly the same so: outlines tell, but no step leads there.
std::vector<Turning> swapped(const Turning& t, const SpinBody& body) {
  std::vector<Turning> all;
  for (const Quat& g : body.nearly_alike) {
    all.push_back(t);
    all.back().q = t.q * g;
  }
  return all;
}

}  // namespace

std::vector<Turning> find_turnings(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t count) {
  std::vector<Turning> all;
  if (looks.size() < 3) return all;
  const std::size_t places = std::min(kPlaces, looks.size() - 1);
  for (std::size_t i = 0; i < places; ++i) {
    const std::vector<Turning> some = grown(body, camera, looks, (2 * i + 1) * (looks.size() - 1) / (2 * places));
    all.insert(all.end(), some.begin(), some.end());
  }
  const double from = looks.front().time, to = looks.back().time;
  keep_best(all, body, from, to, 2 * count);
  std::vector<Turning> more = all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Turning& m : mirrored(all[i], body, looks)) more.push_back(m);
    if (i >= kSwapped) continue;
    for (const Turning& m : swapped(all[i], body)) more.push_back(m);
  }
  for (Turning& t : more) t = refined(t, body, camera, looks, 0, looks.size(), 15);
  keep_best(more, body, from, to, count);
  return more;
}

}  // namespace unseen::collision
