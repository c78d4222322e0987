// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/residuals.h"

#include <ceres/loss_function.h>
#include <ceres/sized_cost_function.h>

#include "collision/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kPointHuber = 3.0;        // in noise
constexpr double kOrientationHuber = 2.0;  // in noise
constexpr double kMidpointSigma = 0.5;     // of the bodies' size: fixes the gauge along the impulse

/// What every term knows.
struct Base {
  const Problem& problem;
  const State& reference;
};

/// Many terms of one kind: functions of few parts of the state, through which their derivatives go.
constexpr int kFlightParts = 10;

/// A centre's place, from place and velocity at the impact, down, and the impact's time.
template <class T>
Vec3T<T> flown(const Problem& problem, const PointObservation& seen, const std::array<T, kFlightParts>& in) {
  const PointState<T> start{Vec3T<T>(in[0], in[1], in[2]), Vec3T<T>(in[3], in[4], in[5])};
  Vec3T<T> p = fly<T>(start, Vec3T<T>(in[6], in[7], in[8]) * T(problem.gravity), T(problem.drag[seen.body]), T(seen.time) - in[9]).p;
  constexpr double kNearest = 0.01;  // m: what a step takes behind the camera is far off, and nothing worse
  if (value_of(p.z()) < kNearest) p.z() = T(kNearest);
  return p;
}

template <class T>
std::array<const T*, kFlightParts> flight_parts(const StateT<T>& s, int body, bool after) {
  const Vec3T<T>&p = s.p[body], &v = after ? s.v_after[body] : s.v[body];
  return {&p.x(), &p.y(), &p.z(), &v.x(), &v.y(), &v.z(), &s.down.x(), &s.down.y(), &s.down.z(), &s.time};
}

/// Reprojection of a centre, Eq. 5.22; px over noise.
struct PointTerm : Base {
  static constexpr int kParts = kFlightParts, kResiduals = 2;
  const PointObservation& seen;
  template <class T>
  auto parts(const StateT<T>& s) const { return flight_parts(s, seen.body, seen.after); }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    const Vec3T<T> p = flown<T>(problem, seen, in);
    r[0] = (p.x() / p.z() * problem.camera.fx + problem.camera.cx - seen.pixel.x()) / problem.pixel_sigma;
    r[1] = (p.y() / p.z() * problem.camera.fy + problem.camera.cy - seen.pixel.y()) / problem.pixel_sigma;
  }
};

/// Depth from the projected size, Eq. 5.23.
struct DepthTerm : Base {
  static constexpr int kParts = kFlightParts, kResiduals = 1;
  const PointObservation& seen;
  template <class T>
  auto parts(const StateT<T>& s) const { return flight_parts(s, seen.body, seen.after); }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>&) const {
    using std::log;
    const Vec3T<T> p = flown<T>(problem, seen, in);
    r[0] = log(p.z() / seen.depth) / seen.depth_sigma;
  }
};

/// Geodesic distance to an orientation seen, for Eq. 5.25.
struct OrientationTerm : Base {
  static constexpr int kParts = 7, kResiduals = 3;
  const OrientationObservation& seen;
  template <class T>
  std::array<const T*, kParts> parts(const StateT<T>& s) const {
    const Vec3T<T>&turn = s.turn[seen.body], &h = seen.after ? s.h_after[seen.body] : s.h[seen.body];
    return {&turn.x(), &turn.y(), &turn.z(), &h.x(), &h.y(), &h.z(), &s.time};
  }
  template <class T>
  void of_parts(const std::array<T, kParts>& in, T* r, const StateT<double>& s) const {
    const Vec3& inertia = problem.solids[seen.body].mass.inertia;
    const Vec3 h(value_of(in[3]), value_of(in[4]), value_of(in[5]));
    QuatT<T> q;
    if constexpr (std::is_same_v<T, double>) {
      q = turned<double>(s.q[seen.body], h, inertia, seen.time - in[6]);
    } else {
      // Turning the start and the momentum alike turns the end alike: derivatives along the momentum are enough.
      const auto [end, along_h] = turned_with_derivative(s.q[seen.body], h, inertia, seen.time - in[6].a);
      const Vec3T<T> turn(in[0], in[1], in[2]), step = Vec3T<T>(in[3], in[4], in[5]) - h.cast<T>() - turn.cross(h.cast<T>());
      const Vec3T<T> theta = turn + along_h.template cast<T>() * step - angular_velocity<double>(end, h, inertia).template cast<T>() * (in[6] - in[6].a);
      q = rotation_by<T>(theta) * end.template cast<T>();
    }
    const Vec3T<T> off = rotation_vector<T>(q * seen.q.conjugate().cast<T>());
    for (int i = 0; i < 3; ++i) r[i] = off[i] / problem.orientation_sigma;
  }
};

/// The camera's down is only about right, for Eq. 5.18.
struct GravityTerm : Base {
  static constexpr int kResiduals = 3;
  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    const Vec3T<T> tilt = problem.down.cast<T>().cross(s.down);
    for (int i = 0; i < 3; ++i) r[i] = tilt[i] / problem.down_sigma;
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
    const Vec3T<T> n = normal_by<T>(touch.law, s.p, s.q);
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
  Vec3 normal;

  template <class T>
  void of_state(const StateT<T>& s, T* r) const {
    constexpr double kSigma = 0.005;  // m: the other impact's time is known to a millisecond or two
    r[0] = normal.cast<T>().dot(position_at<T>(problem, s, 0, other.after, other.time) - s.p[0]) / kSigma;
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

using Wide = ceres::Jet<double, kUnknowns>;

/// A term as a cost function; the state and its derivatives come from the evaluation that is under way.
template <class Term>
class TermCost : public ceres::SizedCostFunction<Term::kResiduals, kUnknowns> {
 public:
  TermCost(Term term, const Evaluation& evaluation) : term_(std::move(term)), evaluation_(evaluation) {}

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    constexpr int kResiduals = Term::kResiduals;
    if constexpr (requires { Term::kParts; }) {
      constexpr int kParts = Term::kParts;
      if (!jacobians || !jacobians[0]) {
        std::array<double, kParts> in;
        const auto parts = term_.parts(evaluation_.state);
        for (int i = 0; i < kParts; ++i) in[i] = *parts[i];
        term_.of_parts(in, residuals, evaluation_.state);
        return true;
      }
      using Lean = ceres::Jet<double, kParts>;
      std::array<Lean, kParts> in;
      const auto parts = term_.parts(evaluation_.wide);
      for (int i = 0; i < kParts; ++i) in[i] = Lean(parts[i]->a, i);
      std::array<Lean, kResiduals> r;
      term_.of_parts(in, r.data(), evaluation_.state);
      Eigen::Map<Eigen::Matrix<double, kResiduals, kUnknowns, Eigen::RowMajor>> jacobian(jacobians[0]);
      for (int k = 0; k < kResiduals; ++k) {
        residuals[k] = r[k].a;
        jacobian.row(k).setZero();
        for (int i = 0; i < kParts; ++i) jacobian.row(k) += r[k].v[i] * parts[i]->v.transpose();
      }
    } else {
      if (!jacobians || !jacobians[0]) {
        term_.of_state(evaluation_.state, residuals);
        return true;
      }
      std::array<Wide, kResiduals> r;
      term_.of_state(evaluation_.wide, r.data());
      for (int k = 0; k < kResiduals; ++k) {
        residuals[k] = r[k].a;
        Eigen::Map<Eigen::Matrix<double, kUnknowns, 1>>(jacobians[0] + k * kUnknowns) = r[k].v;
      }
    }
    return true;
  }

 private:
  Term term_;
  const Evaluation& evaluation_;
};

class Adder {
 public:
  Adder(Evaluation& evaluation, ceres::Problem& ceres) : evaluation_(evaluation), ceres_(ceres) {}

  template <class Term>
  void add(const std::string& name, Term term, ceres::LossFunction* loss = nullptr) {
    blocks.push_back({name, ceres_.AddResidualBlock(new TermCost<Term>(std::move(term), evaluation_), loss, evaluation_.unknowns.data())});
  }
  std::vector<NamedBlock> blocks;

 private:
  Evaluation& evaluation_;
  ceres::Problem& ceres_;
};

/// Distance that poses at the impact are known to: touching is asked for within this.
double touch_sigma(const Problem& problem) {
  return 0.001 + 0.005 * std::max(problem.solids[0].mass.extent, problem.solids[1].mass.extent);
}

}  // namespace

void Evaluation::PrepareForEvaluation(bool jacobians, bool new_point) {
  if (!new_point && (!jacobians || has_derivatives)) return;
  state = unpack<double>(problem, reference, unknowns.data());
  has_derivatives = jacobians;
  if (!jacobians) return;
  std::array<Wide, kUnknowns> u;
  for (int i = 0; i < kUnknowns; ++i) u[i] = Wide(unknowns[i], i);
  wide = unpack<Wide>(problem, reference, u.data());
}

std::vector<NamedBlock> add_residuals(const std::optional<Proximity>& touch, Evaluation& evaluation, ceres::Problem& ceres) {
  const Problem& problem = evaluation.problem;
  const State& reference = evaluation.reference;
  const Base base{problem, reference};
  const Terms& terms = problem.terms;
  Adder adder(evaluation, ceres);
  for (const PointObservation& seen : problem.points) {
    adder.add("points", PointTerm{base, seen}, new ceres::HuberLoss(kPointHuber));
    if (terms.size && seen.depth > 0.0) adder.add("size", DepthTerm{base, seen}, new ceres::HuberLoss(1.0));
  }
  if (terms.orientation)
    for (const OrientationObservation& seen : problem.orientations)
      adder.add("orientation", OrientationTerm{base, seen}, new ceres::HuberLoss(kOrientationHuber));
  if (!problem.orientations.empty()) adder.add("spin", SpinTerm{base});
  if (terms.gravity && problem.gravity > 0.0) adder.add("gravity", GravityTerm{base});
  if (terms.energy) adder.add("energy", EnergyTerm{base});
  if (terms.restitution) adder.add("restitution", RestitutionTerm{base});
  if (touch && reference.law) adder.add("friction", FrictionTerm{base});
  if (problem.planar) adder.add("planar", PlanarTerm{base});
  if (touch)
    adder.add("touch", TouchTerm{base, *touch, touch_sigma(problem)});
  else
    adder.add("midpoint", MidpointTerm{base});
  if (problem.fixed_normal)
    for (const OtherContact& other : problem.other_contacts) adder.add("height", HeightTerm{base, other, *problem.fixed_normal});
  if (terms.soft) {
    constexpr double kWeight = 100.0;  // per m/s: the thesis's 10 against the mean squared error of a hundred centroids known to a third of a pixel
    if (terms.momentum && !problem.fixed) adder.add("momentum", MomentumTerm{base, kWeight});
    if (terms.impulse) adder.add("impulse", ImpulseTerm{base, 0.5 * kWeight});
  }
  return adder.blocks;
}

}  // namespace unseen::collision
