// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/noise.h"
#include "collision/solve/rotation.h"
#include "collision/solve/unknowns.h"

// What was seen, as residuals over their noise; parts of residuals.cpp.
namespace unseen::collision {

/// What every term knows.
struct Base {
  const Problem& problem;
  const State& reference;
};

/// Place and velocity at the impact, down, and the impact's time: what a place on a flight depends on.
constexpr int kFlightParts = 10;

template <class T>
std::array<const T*, kFlightParts> flight_parts(const StateT<T>& s, int body, bool after) {
  const Vec3T<T>&p = s.p[body], &v = after ? s.v_after[body] : s.v[body];
  return {&p.x(), &p.y(), &p.z(), &v.x(), &v.y(), &v.z(), &s.down.x(), &s.down.y(), &s.down.z(), &s.time};
}

/// A body's places at some times, each reached from the one before, so they had better lead away from the impact.
template <class T>
std::vector<Vec3T<T>> flown(const Problem& problem, int body, bool after, const std::vector<double>& times, const std::array<T, kFlightParts>& in) {
  constexpr double kNearest = 0.01;  // m: what a step takes behind the camera is far off, and nothing worse
  PointState<T> now{Vec3T<T>(in[0], in[1], in[2]), Vec3T<T>(in[3], in[4], in[5])};
  const Vec3T<T> g = Vec3T<T>(in[6], in[7], in[8]) * T(problem.gravity);
  T time = in[9];
  std::vector<Vec3T<T>> places;
  places.reserve(times.size());
  for (const double next : times) {
    if (problem.flies(body, after)) now = fly<T>(now, g, problem.resistance(body), T(next) - time);
    time = T(next);
    places.push_back(now.p);
    if (value_of(now.p.z()) < kNearest) places.back().z() = T(kNearest);
  }
  return places;
}

/// The place as parts of a term.
template <class T>
std::array<const T*, 3> place_parts(const SeenPlace& place) {
  if constexpr (std::is_same_v<T, double>) return {&place.p.x(), &place.p.y(), &place.p.z()};
  else return {&place.wide.x(), &place.wide.y(), &place.wide.z()};
}

/// How far one coordinate of a centre that is seen is from that of the body's place `p`; px over noise.
template <class T>
T off_along(int axis, const Problem& problem, const PointObservation& seen, const Vec3T<T>& p) {
  const Camera& camera = problem.camera;
  return (p[axis] / p.z() * (axis == 0 ? camera.fx : camera.fy) + (axis == 0 ? camera.cx : camera.cy) - seen.pixel[axis]) / problem.pixel_sigma;
}

/// Reprojection of a centre, Eq. 5.22; px over noise.
struct PointTerm : Base {
  static constexpr int kParts = 3, kResiduals = 2;
  const PointObservation& seen;
  const SeenPlace& place;
  template <class T>
  auto parts(const StateT<T>&) const { return place_parts<T>(place); }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    for (const int axis : {0, 1}) r[axis] = off_along<T>(axis, problem, seen, Vec3T<T>(in[0], in[1], in[2]));
  }
};

/// One coordinate of a centre with noise that is flat; its loss is the square of the square.
struct FlatPointTerm : Base {
  static constexpr int kParts = 3, kResiduals = 1;
  const PointObservation& seen;
  const SeenPlace& place;
  int axis;
  template <class T>
  auto parts(const StateT<T>&) const { return place_parts<T>(place); }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    *r = flat_residual(off_along<T>(axis, problem, seen, Vec3T<T>(in[0], in[1], in[2])), problem.noise_power);
  }
};

/// Depth from the projected size, Eq. 5.23.
struct DepthTerm : Base {
  static constexpr int kParts = 1, kResiduals = 1;
  const PointObservation& seen;
  const SeenPlace& place;
  template <class T>
  std::array<const T*, kParts> parts(const StateT<T>&) const { return {place_parts<T>(place)[2]}; }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    using std::log;
    r[0] = log(in[0] / seen.depth) / seen.depth_sigma;
  }
};

/// Change of the distance along a flight by the projected sizes.
struct TrendTerm : Base {
  static constexpr int kParts = kFlightParts, kResiduals = 1;
  const SizeTrend& seen;
  template <class T>
  auto parts(const StateT<T>& s) const { return flight_parts(s, seen.body, seen.after); }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    using std::log;
    const auto distance = [&](double time) { return flown<T>(problem, seen.body, seen.after, {time}, in)[0].z(); };
    r[0] = (log(distance(seen.end) / distance(seen.begin)) - seen.change) / seen.sigma;
  }
};

/// Geodesic distance to an orientation seen, for Eq. 5.25.
struct OrientationTerm : Base {
  static constexpr int kParts = 7, kResiduals = 3;
  const OrientationObservation& seen;
  const TurnedEnd& turned;  ///< at the unknowns, with derivatives where they are asked for
  template <class T>
  std::array<const T*, kParts> parts(const StateT<T>& s) const {
    const Vec3T<T>&turn = s.turn[seen.body], &h = seen.after ? s.h_after[seen.body] : s.h[seen.body];
    return {&turn.x(), &turn.y(), &turn.z(), &h.x(), &h.y(), &h.z(), &s.time};
  }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    const Vec3& inertia = problem.solids[seen.body].mass.inertia;
    const Vec3 h(value_of(in[3]), value_of(in[4]), value_of(in[5]));
    QuatT<T> q;
    if constexpr (std::is_same_v<T, double>) {
      q = turned.q;
    } else {
      // Turning the start and the momentum alike turns the end alike: derivatives along the momentum are enough.
      const Vec3T<T> turn(in[0], in[1], in[2]), step = Vec3T<T>(in[3], in[4], in[5]) - h.cast<T>() - turn.cross(h.cast<T>());
      const Vec3T<T> theta = turn + turned.along_h.cast<T>() * step - angular_velocity<double>(turned.q, h, inertia).cast<T>() * (in[6] - in[6].a);
      q = rotation_by<T>(theta) * turned.q.cast<T>();
    }
    const Vec3T<T> off = rotation_vector<T>(q * seen.q.conjugate().cast<T>());
    for (int i = 0; i < 3; ++i) r[i] = off[i] / problem.orientation_sigma;
  }
};

}  // namespace unseen::collision
