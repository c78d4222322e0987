// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/residuals.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>

#include "collision/turned_jet.h"
#include "collision/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kPointHuber = 3.0;        // in noise
constexpr double kOrientationHuber = 2.0;  // in noise
constexpr double kMidpointSigma = 0.5;     // of the bodies' size: fixes the gauge along the impulse
constexpr double kBound = 0.01;            // restitution beyond [0,1] and growing energy, as a share

/// What every term knows.
struct Base {
  const Problem& problem;
  const State& reference;
};

/// Reprojection of a centre, Eq. 5.22; px over noise.
struct PointTerm : Base {
  const PointObservation& seen;
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const Vec3T<T> p = position_at<T>(problem, s, seen.body, seen.after, seen.time);
    if (value_of(p.z()) < 1e-3) return false;
    r[0] = (p.x() / p.z() * problem.camera.fx + problem.camera.cx - seen.pixel.x()) / problem.pixel_sigma;
    r[1] = (p.y() / p.z() * problem.camera.fy + problem.camera.cy - seen.pixel.y()) / problem.pixel_sigma;
    return true;
  }
};

/// Depth from the projected size, Eq. 5.23.
struct DepthTerm : Base {
  const PointObservation& seen;
  template <class T>
  bool operator()(const T* u, T* r) const {
    using std::log;
    const StateT<T> s = unpack<T>(problem, reference, u);
    const Vec3T<T> p = position_at<T>(problem, s, seen.body, seen.after, seen.time);
    if (value_of(p.z()) < 1e-3) return false;
    r[0] = log(p.z() / seen.depth) / seen.depth_sigma;
    return true;
  }
};

/// Geodesic distance to an orientation seen, for Eq. 5.25.
struct OrientationTerm : Base {
  const OrientationObservation& seen;
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const int o = seen.body;
    const QuatT<T> q = turned_lean<T>(s.q[o], seen.after ? s.h_after[o] : s.h[o], problem.solids[o].mass.inertia, T(seen.time) - s.time);
    const Vec3T<T> off = rotation_vector<T>(q * seen.q.conjugate().cast<T>());
    for (int i = 0; i < 3; ++i) r[i] = off[i] / problem.orientation_sigma;
    return true;
  }
};

/// The camera's down is only about right, for Eq. 5.18.
struct GravityTerm : Base {
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const Vec3T<T> tilt = problem.down.cast<T>().cross(s.down);
    for (int i = 0; i < 3; ++i) r[i] = tilt[i] / problem.down_sigma;
    return true;
  }
};

/// An impact takes energy, Eq. 5.19.
struct EnergyTerm : Base {
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const T before = kinetic_energy<T>(problem, s, false), growth = kinetic_energy<T>(problem, s, true) - before;
    r[0] = value_of(growth) > 0.0 ? growth / (before + 1e-9) / kBound : T(0.0);
    return true;
  }
};

/// 0 ≤ c ≤ 1, Eq. 5.21.
struct RestitutionTerm : Base {
  template <class T>
  bool operator()(const T* u, T* r) const {
    const T c = restitution<T>(problem, reference, unpack<T>(problem, reference, u));
    r[0] = value_of(c) < 0.0 ? c / kBound : value_of(c) > 1.0 ? (c - 1.0) / kBound : T(0.0);
    return true;
  }
};

/// Shapes unknown: the contact point is near the middle, which fixes where along the impulse it is.
struct MidpointTerm : Base {
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const Vec3T<T> middle = problem.fixed ? s.p[0] : Vec3T<T>((s.p[0] + s.p[1]) * 0.5), off = s.x - middle;
    const double size = problem.solids[0].mass.extent + problem.solids[1].mass.extent;
    for (int i = 0; i < 3; ++i) r[i] = off[i] / (kMidpointSigma * size);
    return true;
  }
};

/// Shapes known: the surfaces touch, and the contact point lies on both, as far as edges or faces leave it no slack.
struct TouchTerm : Base {
  Proximity touch;
  std::array<Vec3, 2> local;  // the surface points in the principal frames
  double sigma;               // m

  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const Vec3T<T> a = s.p[0] + s.q[0] * local[0].cast<T>();
    const Vec3T<T> b = problem.fixed ? a : Vec3T<T>(s.p[1] + s.q[1] * local[1].cast<T>());
    r[0] = touch.normal.cast<T>().dot(a - b) / sigma;
    const Vec3T<T> off = touch.axes.transpose().cast<T>() * (s.x - (a + b) * 0.5);
    for (int i = 0; i < 3; ++i) r[1 + i] = off[i] / (sigma + 0.6 * touch.slack[i]);
    return true;
  }
};

/// Gravity-free shots: both bodies move in one plane parallel to the image.
struct PlanarTerm : Base {
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    constexpr double kSpeed = 1e-3, kDepth = 1e-3;  // m/s, m
    for (int o = 0; o < 2; ++o) {
      r[2 * o] = s.v[o].z() / kSpeed;
      r[2 * o + 1] = s.v_after[o].z() / kSpeed;
    }
    r[4] = problem.fixed ? T(0.0) : (s.p[0].z() - s.p[1].z()) / kDepth;
    return true;
  }
};

/// Linear and angular momentum are conserved, Eq. 5.16; soft form.
struct MomentumTerm : Base {
  double weight;
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    const T m = s.mass_ratio;
    const Vec3T<T> dv_a = s.v_after[0] - s.v[0], dv_b = (s.v_after[1] - s.v[1]) * m;
    const Vec3T<T> linear = dv_a + dv_b;
    const Vec3T<T> angular = s.p[0].cross(dv_a) + s.h_after[0] - s.h[0] + s.p[1].cross(dv_b) + (s.h_after[1] - s.h[1]) * m;
    for (int i = 0; i < 3; ++i) r[i] = linear[i] * weight, r[3 + i] = angular[i] * weight;
    return true;
  }
};

/// The impulse explains every change, Eq. 5.17; soft form.
struct ImpulseTerm : Base {
  double weight;
  template <class T>
  bool operator()(const T* u, T* r) const {
    const StateT<T> s = unpack<T>(problem, reference, u);
    for (int o = 0; o < 2; ++o) {
      const T mass = o == 0 ? T(1.0) : s.mass_ratio;
      const Vec3T<T> j = o == 0 ? s.impulse : Vec3T<T>(-s.impulse);
      Vec3T<T> linear = s.v[o] + j / mass - s.v_after[o];
      Vec3T<T> angular = (s.h[o] - s.h_after[o]) * mass + (s.x - s.p[o]).cross(j);
      if (o == 1 && problem.fixed) linear *= T(0.0), angular *= T(0.0);
      for (int i = 0; i < 3; ++i) r[6 * o + i] = linear[i] * weight, r[6 * o + 3 + i] = angular[i] * weight;
    }
    return true;
  }
};

class Adder {
 public:
  Adder(double* unknowns, ceres::Problem& ceres) : unknowns_(unknowns), ceres_(ceres) {}

  template <int kResiduals, class Term>
  void add(const std::string& name, Term term, ceres::LossFunction* loss = nullptr) {
    auto* cost = new ceres::AutoDiffCostFunction<Term, kResiduals, kUnknowns>(new Term(std::move(term)));
    blocks.push_back({name, ceres_.AddResidualBlock(cost, loss, unknowns_)});
  }
  std::vector<NamedBlock> blocks;

 private:
  double* unknowns_;
  ceres::Problem& ceres_;
};

/// Distance that poses at the impact are known to: touching is asked for within this.
double touch_sigma(const Problem& problem) {
  return 0.001 + 0.005 * std::max(problem.solids[0].mass.extent, problem.solids[1].mass.extent);
}

}  // namespace

std::vector<NamedBlock> add_residuals(const Problem& problem, const State& reference, const std::optional<Proximity>& touch, double* unknowns,
                                      ceres::Problem& ceres) {
  const Base base{problem, reference};
  const Terms& terms = problem.terms;
  Adder adder(unknowns, ceres);
  for (const PointObservation& seen : problem.points) {
    adder.add<2>("points", PointTerm{base, seen}, new ceres::HuberLoss(kPointHuber));
    if (terms.size && seen.depth > 0.0) adder.add<1>("size", DepthTerm{base, seen}, new ceres::HuberLoss(1.0));
  }
  if (terms.orientation)
    for (const OrientationObservation& seen : problem.orientations)
      adder.add<3>("orientation", OrientationTerm{base, seen}, new ceres::HuberLoss(kOrientationHuber));
  if (terms.gravity && problem.gravity > 0.0) adder.add<3>("gravity", GravityTerm{base});
  if (terms.energy) adder.add<1>("energy", EnergyTerm{base});
  if (terms.restitution) adder.add<1>("restitution", RestitutionTerm{base});
  if (problem.planar) adder.add<5>("planar", PlanarTerm{base});
  if (touch)
    adder.add<4>("touch", TouchTerm{base, *touch,
                                    {reference.q[0].conjugate() * (touch->point_a - reference.p[0]),
                                     reference.q[1].conjugate() * (touch->point_b - reference.p[1])},
                                    touch_sigma(problem)});
  else
    adder.add<3>("midpoint", MidpointTerm{base});
  if (terms.soft) {
    // The thesis weighs by 10 against the mean squared reprojection error in pixels; here errors are over noise and summed.
    const double weight = std::sqrt(10.0 * static_cast<double>(problem.points.size())) / problem.pixel_sigma;
    if (terms.momentum && !problem.fixed) adder.add<6>("momentum", MomentumTerm{base, weight});
    if (terms.impulse) adder.add<12>("impulse", ImpulseTerm{base, 0.5 * weight});
  }
  return adder.blocks;
}

}  // namespace unseen::collision
