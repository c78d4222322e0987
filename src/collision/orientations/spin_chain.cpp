// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/spin_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "collision/solve/rotation.h"

namespace unseen::collision {
namespace {

constexpr double kJoint = 0.12;      // rad, between two motions at the impact
constexpr double kLate = 1.0;        // frames, of the impact's time
constexpr double kBroken = 25.0;     // χ² from where on it grows slowly
constexpr double kNear = 0.7;        // rad: symmetries that are compared by colour

/// What it costs that one motion follows another, with the symmetry that lets it.
struct Link {
  double cost = 0;
  Quat alike = Quat::Identity();
};
using Links = std::vector<std::vector<Link>>;  ///< [before][after]

std::optional<double> meeting_between(const Tracks& tracks, int before, int after) {
  const auto among = [](const std::vector<int>& spans, int s) { return std::find(spans.begin(), spans.end(), s) != spans.end(); };
  for (const Tracks::Meeting& m : tracks.meetings)
    if (among(m.before, before) && among(m.after, after)) return m.time;
  return std::nullopt;
}

double speed(const Turning& t, const SpinBody& body) { return angular_velocity<double>(t.q, t.h, body.solid.mass.inertia).norm(); }

class Joiner {
 public:
  Joiner(const SpinBody& body, const std::vector<SurfacePoint>& points, const Camera& camera, double fps)
      : body_(body), points_(points), camera_(camera), fps_(fps) {}

  Links links(const SpinFlight& before, const SpinFlight& after, double time) const {
    struct Choice { double gap, variance; Quat alike; };
    std::vector<const Look*> looks;
    for (const SpinFlight* f : {&before, &after})
      for (const Look& look : f->looks) looks.push_back(&look);
    std::vector<std::vector<std::vector<Choice>>> choices(before.turnings.size(), std::vector<std::vector<Choice>>(after.turnings.size()));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < before.turnings.size(); ++i) {
      const Quat q = at_time(before.turnings[i], body_, time).q;
      const std::vector<Quat> first = orientations_of(before.turnings[i], body_, before.looks);
      for (std::size_t j = 0; j < after.turnings.size(); ++j) {
        const Turning next = at_time(after.turnings[j], body_, time);
        const double slack = std::hypot(kJoint, kLate / fps_ * (speed(before.turnings[i], body_) + speed(next, body_)));
        const Quat nearest = nearest_alike(next.q, q, body_.symmetry.turns);
        const std::vector<Quat> second = orientations_of(after.turnings[j], body_, after.looks);
        for (const Quat& g : body_.symmetry.turns) {
          const double angle = q.angularDistance(next.q * g);
          if (angle > std::max(kNear, nearest.angularDistance(q) + 1e-6)) continue;
          std::vector<Quat> all = first;
          for (const Quat& s : second) all.push_back(s * g);
          const double variance = color_variance(points_, camera_, looks, all);
          if (variance > 0.0) least = std::min(least, variance);
          choices[i][j].push_back({angle / slack, variance, g});
        }
      }
    }
    Links result(before.turnings.size(), std::vector<Link>(after.turnings.size()));
    for (std::size_t i = 0; i < result.size(); ++i)
      for (std::size_t j = 0; j < result[i].size(); ++j) {
        result[i][j].cost = std::numeric_limits<double>::infinity();
        for (const Choice& c : choices[i][j]) {
          double cost = kBroken * std::log1p(c.gap * c.gap / kBroken);
          if (c.variance > 0.0) cost += color_cost(c.variance, least, std::sqrt(static_cast<double>(looks.size())));
          if (cost < result[i][j].cost) result[i][j] = {cost, c.alike};
        }
      }
    return result;
  }

 private:
  const SpinBody& body_;
  const std::vector<SurfacePoint>& points_;
  const Camera& camera_;
  double fps_;
};

}  // namespace

void join_flights(const std::vector<SpinFlight*>& flights, const SpinBody& body, const std::vector<SurfacePoint>& points,
                  const Camera& camera, const Tracks& tracks, double fps) {
  const Joiner joiner(body, points, camera, fps);
  std::vector<std::optional<Links>> links(flights.size());  // to the flight before
  std::vector<std::vector<double>> forward, backward(flights.size());
  for (std::size_t f = 0; f < flights.size(); ++f) {
    SpinFlight& now = *flights[f];
    now.alike.assign(now.turnings.size(), Quat::Identity());
    forward.push_back(now.costs);
    backward[f].assign(now.costs.size(), 0.0);
    if (f == 0 || now.turnings.empty() || flights[f - 1]->turnings.empty()) continue;
    const auto time = meeting_between(tracks, flights[f - 1]->span, now.span);
    if (!time) continue;
    links[f] = joiner.links(*flights[f - 1], now, *time);
    for (std::size_t j = 0; j < now.turnings.size(); ++j) {
      std::size_t best = 0;
      const auto cost = [&](std::size_t i) { return forward[f - 1][i] + (*links[f])[i][j].cost; };
      for (std::size_t i = 1; i < flights[f - 1]->turnings.size(); ++i)
        if (cost(i) < cost(best)) best = i;
      forward[f][j] += cost(best);
      now.alike[j] = (*links[f])[best][j].alike * flights[f - 1]->alike[best];
    }
  }
  for (std::size_t f = flights.size(); f-- > 1;) {
    if (!links[f]) continue;
    for (std::size_t i = 0; i < backward[f - 1].size(); ++i) {
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < backward[f].size(); ++j)
        best = std::min(best, (*links[f])[i][j].cost + flights[f]->costs[j] + backward[f][j]);
      backward[f - 1][i] = best;
    }
  }
  for (std::size_t f = 0; f < flights.size(); ++f)
    for (std::size_t i = 0; i < flights[f]->costs.size(); ++i) flights[f]->costs[i] = forward[f][i] + backward[f][i];
}

}  // namespace unseen::collision
