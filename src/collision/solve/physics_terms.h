// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>

#include "collision/solve/residuals.h"
#include "collision/solve/seen_terms.h"

// What must be true of an impact, as residuals; parts of residuals.cpp.
namespace unseen::collision {

/// The camera's down is only about right, for Eq. 5.18.
struct GravityTerm : Base {
  static constexpr int kResiduals = 3;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const Vec3T<T> tilt = problem.down.cast<T>().cross(s.down);
    for (int i = 0; i < 3; ++i) r[i] = tilt[i] / problem.down_sigma;
  }
};

/// Walls are plumb; friction and spin turn the impulse a little.
struct PlumbTerm : Base {
  static constexpr int kResiduals = 1;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kSigma = 0.1;  // rad
    r[0] = (problem.fixed_normal ? s.down.dot(problem.fixed_normal->cast<T>()) : s.down.dot(s.impulse) / s.impulse.norm()) / kSigma;
  }
};

/// An impact takes energy, Eq. 5.19.
struct EnergyTerm : Base {
  static constexpr int kResiduals = 1;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const T before = kinetic_energy<T>(problem, s, false), growth = kinetic_energy<T>(problem, s, true) - before;
    r[0] = value_of(growth) > 0.0 ? growth / (before + 1e-9) / kBound : T(0.0);
  }
};

/// 0 ≤ c ≤ 1, Eq. 5.21; or the value that is known.
struct RestitutionTerm : Base {
  static constexpr int kResiduals = 1;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const T c = restitution<T>(problem, reference, s);
    if (problem.restitution)
      r[0] = (c - *problem.restitution) / (0.1 * kBound);
    else
      r[0] = value_of(c) < 0.0 ? c / kBound : value_of(c) > 1.0 ? (c - 1.0) / kBound : T(0.0);
  }
};

/// Nobody throws faster than some turns a second: keeps what little was seen of from running away.
struct SpinTerm : Base {
  static constexpr int kResiduals = 12;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kUsual = 40.0;  // rad/s
    for (int o = 0; o < 2; ++o) {
      const double scale = problem.solids[o].mass.inertia.mean() * kUsual;
      for (int i = 0; i < 3; ++i) {
        const bool counts = problem.turns(o) && scale > 0.0;
        r[6 * o + i] = counts ? s.h[o][i] / scale : T(0.0);
        r[6 * o + 3 + i] = counts ? s.h_after[o][i] / scale : T(0.0);
      }
    }
  }
};

constexpr double kMidpointSigma = 0.5;  // of the bodies' size: fixes the gauge along the impulse

/// Shapes unknown: the contact point is near the middle, which fixes where along the impulse it is.
struct MidpointTerm : Base {
  static constexpr int kResiduals = 3;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const Vec3T<T> middle = problem.fixed ? s.p[0] : Vec3T<T>((s.p[0] + s.p[1]) * 0.5), off = s.x - middle;
    const double size = problem.solids[0].mass.extent + problem.solids[1].mass.extent;
    for (int i = 0; i < 3; ++i) r[i] = off[i] / (kMidpointSigma * size);
  }
};

/// Shapes known: the contact point lies on the features of both that touch.
struct TouchTerm : Base {
  static constexpr int kResiduals = 6;
  Proximity touch;
  double sigma;  // m

  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kAlong = 0.6;  // of a feature's half extent
    const Vec3T<T> n = normal_by<T>(touch.law, s.p, s.q, s.down);
    for (int o = 0; o < 2; ++o) {
      T* out = r + 3 * o;
      if (o == 1 && problem.fixed) {
        out[0] = problem.fixed_offset ? (n.dot(s.x) - *problem.fixed_offset) / sigma : T(0.0);
        out[1] = out[2] = T(0.0);
        continue;
      }
      if (problem.solids[o].is_sphere()) {
        const Vec3T<T> off = s.x - s.p[o] + n * T((o == 0 ? 1.0 : -1.0) * problem.solids[o].radius);
        for (int i = 0; i < 3; ++i) out[i] = off[i] / sigma;
        continue;
      }
      const Feature& feature = touch.features[o];
      const Quat back = reference.q[o].conjugate();
      const Mat3 axes = back * feature.axes;
      const Vec3 at = back * (feature.point - reference.p[o]);
      const Vec3T<T> off = axes.transpose().cast<T>() * (s.q[o].conjugate() * (s.x - s.p[o]) - at.cast<T>());
      for (int i = 0; i < 3; ++i) out[i] = off[i] / (sigma + kAlong * feature.extent[i]);
    }
  }
};

/// A ball that meets the same plane again is as high then as now.
struct HeightTerm : Base {
  static constexpr int kResiduals = 1;
  OtherContact other;

  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kSigma = 0.005;  // m: the other impact's time is known to a millisecond or two
    const Vec3T<T> n = problem.level ? Vec3T<T>(-s.down) : Vec3T<T>(problem.fixed_normal->cast<T>());
    r[0] = n.dot(position_at<T>(problem, s, 0, other.after, other.time) - s.p[0]) / kSigma;
  }
};

/// Coulomb: an impulse far off the normal would need uncommon friction.
struct FrictionTerm : Base {
  static constexpr int kResiduals = 3;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kUsual = 0.4;  // coefficient of friction
    const Vec3T<T> n = contact_normal<T>(reference, s), across = s.impulse - n * s.impulse.dot(n);
    using std::sqrt;
    for (int i = 0; i < 3; ++i) r[i] = across[i] / (kUsual * sqrt(s.impulse.squaredNorm() + 1e-12));
  }
};

/// Friction slows the slide of one ball on another, at most to rest. Weak, as balls whose turning nobody saw may spin before.
struct SlideTerm : Base {
  static constexpr int kResiduals = 3;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kSpin = 20.0;  // rad/s
    const Vec3T<T> n = contact_normal<T>(reference, s);
    const auto slide = [&](bool after) {
      const Vec3T<T> v = contact_velocity<T>(problem, s, 0, after) - contact_velocity<T>(problem, s, 1, after);
      return Vec3T<T>(v - n * v.dot(n));
    };
    const Vec3T<T> before = slide(false), after = slide(true);
    const T share = after.dot(before) / (before.squaredNorm() + 1e-12), left = value_of(share) < 0.0 ? T(0.0) : value_of(share) > 1.0 ? T(1.0) : share;
    const Vec3T<T> off = after - before * left;
    for (int i = 0; i < 3; ++i) r[i] = off[i] / (kSpin * (problem.solids[0].radius + problem.solids[1].radius));
  }
};

/// Gravity-free shots: both bodies move in one plane parallel to the image.
struct PlanarTerm : Base {
  static constexpr int kResiduals = 5;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kSpeed = 1e-3, kDepth = 1e-3;  // m/s, m
    for (int o = 0; o < 2; ++o) {
      r[2 * o] = s.v[o].z() / kSpeed;
      r[2 * o + 1] = s.v_after[o].z() / kSpeed;
    }
    r[4] = problem.fixed ? T(0.0) : (s.p[0].z() - s.p[1].z()) / kDepth;
  }
};

/// Linear and angular momentum are conserved, Eq. 5.16; soft form.
struct MomentumTerm : Base {
  static constexpr int kResiduals = 6;
  double weight;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const T m = s.mass_ratio;
    const Vec3T<T> dv_a = s.v_after[0] - s.v[0], dv_b = (s.v_after[1] - s.v[1]) * m;
    const Vec3T<T> linear = dv_a + dv_b;
    const Vec3T<T> angular = s.p[0].cross(dv_a) + s.h_after[0] - s.h[0] + s.p[1].cross(dv_b) + (s.h_after[1] - s.h[1]) * m;
    for (int i = 0; i < 3; ++i) r[i] = linear[i] * weight, r[3 + i] = angular[i] * weight;
  }
};

/// The impulse explains every change, Eq. 5.17; soft form.
struct ImpulseTerm : Base {
  static constexpr int kResiduals = 12;
  double weight;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    for (int o = 0; o < 2; ++o) {
      const T mass = o == 0 ? T(1.0) : s.mass_ratio;
      const Vec3T<T> j = o == 0 ? s.impulse : Vec3T<T>(-s.impulse);
      Vec3T<T> linear = s.v[o] + j / mass - s.v_after[o];
      Vec3T<T> angular = (s.h[o] - s.h_after[o]) * mass + (s.x - s.p[o]).cross(j);
      if (o == 1 && problem.fixed) linear *= T(0.0), angular *= T(0.0);
      for (int i = 0; i < 3; ++i) r[6 * o + i] = linear[i] * weight, r[6 * o + 3 + i] = angular[i] * weight;
    }
  }
};

}  // namespace unseen::collision
