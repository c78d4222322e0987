// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "collision/orientations/appearance.h"
#include "collision/orientations/looks.h"
#include "collision/orientations/orientations.h"
#include "collision/orientations/spin_chain.h"
#include "collision/orientations/spin_search.h"
#include "collision/solve/rotation.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kTurnings = 10;     // followed up a flight
constexpr std::size_t kRefined = 6;       // of those, by colours too
constexpr std::size_t kPoints = 400;      // of a surface
constexpr double kIndependentDirections = 10.0;     // directions of a silhouette
constexpr double kOutlineError = 0.03;           // rad: what outlines that are cut wrongly do to a whole motion
constexpr double kVaguest = 0.5;          // rad, of an orientation as an observation

bool has_spin(const Body& body) { return body.shape == Shape::box || body.shape == Shape::mesh; }

/// χ² of a flight's motions: silhouettes over the noise that the best one leaves, and colours.
void add_colors(SpinFlight& flight, const SpinBody& body, const std::vector<SurfacePoint>& points, const Camera& camera) {
  std::vector<const Look*> looks;
  for (const Look& look : flight.looks) looks.push_back(&look);
  std::vector<double> variances;
  for (const Turning& t : flight.turnings)
    variances.push_back(color_variance(points, camera, looks, orientations_of(t, body, flight.looks)));
  const double least = *std::min_element(variances.begin(), variances.end());
  for (std::size_t i = 0; i < variances.size(); ++i) {
    flight.turnings[i].cost /= flight.noise * flight.noise;
    if (least > 0.0) flight.turnings[i].cost += color_cost(variances[i], least, static_cast<double>(looks.size()));
  }
  keep_best(flight.turnings, body, flight.looks.front().time, flight.looks.back().time, kRefined);
}

/// The motions of one flight by themselves.
void search(SpinFlight& flight, const SpinBody& body, const std::vector<SurfacePoint>& points, const Camera& camera) {
  flight.turnings = find_turnings(body, camera, flight.looks, kTurnings);
  if (flight.turnings.empty()) return;
  const double freedom = std::max(1.0, kIndependentDirections * static_cast<double>(flight.looks.size()) - 6.0);
  flight.noise = std::sqrt(std::max(1.0, flight.turnings.front().cost / freedom));
  add_colors(flight, body, points, camera);
  for (Turning& t : flight.turnings) t = refined_by_colors(t, body, camera, flight.looks, points, flight.noise);
  add_colors(flight, body, points, camera);
  for (const Turning& t : flight.turnings) flight.costs.push_back(t.cost);
}

/// Standard deviation of the motion's orientation at a time, rad.
double uncertainty(const Turning& turning, const SpinBody& body, double noise, double time) {
  const auto along = turned_through(turning.q, turning.h, body.solid.mass.inertia, {time - turning.time}, true).front().along_h;
  Eigen::Matrix<double, 3, 6> change;
  change << Mat3::Identity(), along;
  Eigen::Matrix<double, 6, 6> information = turning.information;
  information.diagonal() *= 1.0 + 1e-9;
  const Eigen::Matrix<double, 6, 3> solved = information.ldlt().solve(change.transpose());
  return noise * std::sqrt(std::max(0.0, (change * solved).trace() / 3.0));
}

/// The end of a span that an impact touches: its last point's time, or its first one's.
double impact_end(const Tracks& tracks, int span) {
  const FlightSpan& s = tracks.spans[static_cast<std::size_t>(span)];
  const auto among = [&](const std::vector<int>& spans) { return std::find(spans.begin(), spans.end(), span) != spans.end(); };
  for (const Tracks::Meeting& m : tracks.meetings)
    if (among(m.after)) return tracks.points[s.begin].time;
  return tracks.points[s.end - 1].time;
}

Spin spin_of(const SpinFlight& flight, std::size_t index, const SpinBody& body, int body_index, const Tracks& tracks) {
  Turning turning = flight.turnings[index];
  turning.q = turning.q * flight.alike[index];
  const Quat& to_principal = body.solid.file_to_principal;
  const Turning at_end = at_time(turning, body, impact_end(tracks, flight.span));
  Spin spin;
  spin.span = flight.span;
  spin.time = at_end.time;
  spin.q = at_end.q * to_principal;
  spin.omega = angular_velocity<double>(at_end.q, at_end.h, body.solid.mass.inertia);
  spin.cost = flight.costs[index];
  const std::vector<Quat> all = orientations_of(turning, body, flight.looks);
  // the orientations come from one motion of six numbers: together they are to weigh as much as those
  const double shared = std::sqrt(0.5 * static_cast<double>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double time = flight.looks[i].time, sigma = shared * std::hypot(kOutlineError, uncertainty(turning, body, flight.noise, time));
    spin.orientations.push_back({body_index, time, all[i] * to_principal, std::min(sigma, kVaguest)});
  }
  return spin;
}

/// The flights of one body, with the motions that their silhouettes allow.
std::vector<SpinFlight> flights_of(int index, const SpinBody& body, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                                   const std::vector<Vec3>& centers) {
  std::vector<SpinFlight> flights;
  for (std::size_t s = 0; s < tracks.spans.size(); ++s) {
    if (tracks.spans[s].body != index) continue;
    SpinFlight flight;
    flight.span = static_cast<int>(s);
    flight.looks = choose_looks(body, camera, footage, tracks, centers, tracks.spans[s]);
    flights.push_back(std::move(flight));
  }
  return flights;
}

}  // namespace

std::vector<std::vector<Spin>> find_spins(const Shot& shot, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                                          const std::vector<Vec3>& centers, int keep, Context& context) {
  std::vector<std::vector<Spin>> spins(tracks.spans.size());
  std::vector<SpinBody> bodies(shot.bodies.size());
  std::vector<SpinFlight> flights;
  for (std::size_t b = 0; b < shot.bodies.size(); ++b) {
    if (!has_spin(shot.bodies[b])) continue;
    bodies[b] = spin_body(shot.bodies[b], shot.name);
    for (SpinFlight& f : flights_of(static_cast<int>(b), bodies[b], camera, footage, tracks, centers)) flights.push_back(std::move(f));
  }
  std::vector<std::vector<Look>*> looks;
  for (SpinFlight& f : flights) looks.push_back(&f.looks);
  read_pictures(shot, camera, footage, looks, context);
  std::vector<std::vector<SurfacePoint>> points(shot.bodies.size());
  for (std::size_t b = 0; b < shot.bodies.size(); ++b)
    if (has_spin(shot.bodies[b])) points[b] = surface_points(shot.bodies[b], bodies[b], kPoints, shot.name);
  parallel_blocks(context, flights.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto b = static_cast<std::size_t>(tracks.spans[static_cast<std::size_t>(flights[i].span)].body);
      search(flights[i], bodies[b], points[b], camera.camera);
    }
  });
  context.check();
  for (std::size_t b = 0; b < shot.bodies.size(); ++b) {
    std::vector<SpinFlight*> own;
    for (SpinFlight& f : flights)
      if (tracks.spans[static_cast<std::size_t>(f.span)].body == static_cast<int>(b)) own.push_back(&f);
    join_flights(own, bodies[b], points[b], camera.camera, tracks, footage.fps);
    for (const SpinFlight* f : own) {
      auto& list = spins[static_cast<std::size_t>(f->span)];
      for (std::size_t i = 0; i < f->turnings.size(); ++i) list.push_back(spin_of(*f, i, bodies[b], static_cast<int>(b), tracks));
      std::stable_sort(list.begin(), list.end(), [](const Spin& x, const Spin& y) { return x.cost < y.cost; });
      list.resize(std::min(list.size(), static_cast<std::size_t>(std::max(keep, 0))));
    }
  }
  return spins;
}

}  // namespace unseen::collision
