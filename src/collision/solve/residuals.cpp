// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/residuals.h"

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>

#include <algorithm>

#include "collision/solve/physics_terms.h"
#include "collision/solve/seen_terms.h"

namespace unseen::collision {
namespace {

constexpr double kPointHuber = 3.0;        // in noise
constexpr double kOrientationHuber = 2.0;  // in noise

/// A term as a cost function; the state and its derivatives come from the evaluation that is under way.
template <class Term>
class TermCost : public ceres::CostFunction {
 public:
  TermCost(Term term, const EvaluatedState& evaluation) : term_(std::move(term)), evaluation_(evaluation) {
    set_num_residuals(Term::kResiduals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(evaluation.steps.size()));
  }

  /// False where a step led to where nothing can be computed.
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    constexpr int kResiduals = Term::kResiduals;
    const bool derive = jacobians && jacobians[0];
    compute(residuals, derive ? jacobians[0] : nullptr);
    return Eigen::Map<const Eigen::Matrix<double, kResiduals, 1>>(residuals).allFinite() &&
           (!derive || Eigen::Map<const Eigen::VectorXd>(jacobians[0], kResiduals * free()).allFinite());
  }

 private:
  Eigen::Index free() const { return static_cast<Eigen::Index>(evaluation_.steps.size()); }

  /// Row by row; no derivatives without `jacobian`.
  void compute(double* residuals, double* jacobian) const {
    constexpr int kResiduals = Term::kResiduals;
    if constexpr (requires { Term::kParts; }) {
      constexpr int kParts = Term::kParts;
      if (!jacobian) {
        std::array<double, kParts> in;
        const auto parts = term_.parts(evaluation_.state);
        for (int i = 0; i < kParts; ++i) in[i] = *parts[i];
        term_.of_parts(in, residuals, evaluation_.state);
        return;
      }
      using Lean = ceres::Jet<double, kParts>;
      std::array<Lean, kParts> in;
      const auto parts = term_.parts(evaluation_.wide);
      for (int i = 0; i < kParts; ++i) in[i] = Lean(parts[i]->a, i);
      std::array<Lean, kResiduals> r;
      term_.of_parts(in, r.data(), evaluation_.state);
      for (int k = 0; k < kResiduals; ++k) {
        residuals[k] = r[k].a;
        Eigen::Map<Eigen::VectorXd> row(jacobian + k * free(), free());
        row.setZero();
        for (int i = 0; i < kParts; ++i) row += r[k].v[i] * parts[i]->v.head(free());
      }
    } else {
      if (!jacobian) {
        term_.of_state(evaluation_.state, residuals);
        return;
      }
      std::array<Wide, kResiduals> r;
      term_.of_state(evaluation_.wide, r.data());
      for (int k = 0; k < kResiduals; ++k) {
        residuals[k] = r[k].a;
        Eigen::Map<Eigen::VectorXd>(jacobian + k * free(), free()) = r[k].v.head(free());
      }
    }
  }

  Term term_;
  const EvaluatedState& evaluation_;
};

/// Half of it is the fourth power of the residual.
class SquareLoss : public ceres::LossFunction {
 public:
  void Evaluate(double s, double rho[3]) const override {
    rho[0] = 2.0 * s * s;
    rho[1] = 4.0 * s;
    rho[2] = 4.0;
  }
};

class Adder {
 public:
  Adder(EvaluatedState& evaluation, ceres::Problem& ceres) : evaluation_(evaluation), ceres_(ceres) {}

  template <class Term>
  void add(const std::string& name, Term term, ceres::LossFunction* loss = nullptr) {
    blocks.push_back({name, ceres_.AddResidualBlock(new TermCost<Term>(std::move(term), evaluation_), loss, evaluation_.steps.data())});
  }
  std::vector<NamedBlock> blocks;

 private:
  EvaluatedState& evaluation_;
  ceres::Problem& ceres_;
};

/// Distance that poses at the impact are known to: touching is asked for within this.
double touch_sigma(const Problem& problem) {
  return 0.001 + 0.005 * std::max(problem.solids[0].mass.extent, problem.solids[1].mass.extent);
}

}  // namespace

EvaluatedState::EvaluatedState(const Problem& problem, const State& reference, std::vector<int> free)
    : problem(problem), reference(reference), free(std::move(free)), steps(this->free.size()), turned(problem.orientations.size()), places(problem.points.size()) {
  const auto outwards = [](const auto& observations, int body, bool after, std::vector<SeenOutwards>& all) {
    SeenOutwards side{body, after, {}};
    for (std::size_t i = 0; i < observations.size(); ++i)
      if (observations[i].body == body && observations[i].after == after) side.seen.push_back(i);
    const auto time = [&](std::size_t i) { return observations[i].time; };
    std::stable_sort(side.seen.begin(), side.seen.end(), [&](std::size_t a, std::size_t b) { return after ? time(a) < time(b) : time(a) > time(b); });
    if (!side.seen.empty()) all.push_back(std::move(side));
  };
  for (const int body : {0, 1})
    for (const bool after : {false, true}) {
      outwards(problem.points, body, after, flights_);
      if (problem.terms.orientation) outwards(problem.orientations, body, after, turnings_);
    }
}

std::array<double, kUnknowns> EvaluatedState::unknowns() const {
  std::array<double, kUnknowns> all = {};
  for (std::size_t i = 0; i < free.size(); ++i) all[static_cast<std::size_t>(free[i])] = steps[i];
  return all;
}

void EvaluatedState::fly(const SeenOutwards& flight, bool derivatives) {
  const auto& [body, after, seen] = flight;
  std::vector<double> times;
  for (const std::size_t i : seen) times.push_back(problem.points[i].time);
  if (!derivatives) {
    std::array<double, kFlightParts> in;
    const auto parts = flight_parts(state, body, after);
    for (int i = 0; i < kFlightParts; ++i) in[i] = *parts[i];
    const std::vector<Vec3> at = flown<double>(problem, body, after, times, in);
    for (std::size_t k = 0; k < seen.size(); ++k) places[seen[k]].p = at[k];
    return;
  }
  using Lean = ceres::Jet<double, kFlightParts>;
  std::array<Lean, kFlightParts> in;
  const auto parts = flight_parts(wide, body, after);
  for (int i = 0; i < kFlightParts; ++i) in[i] = Lean(parts[i]->a, i);
  const std::vector<Vec3T<Lean>> at = flown<Lean>(problem, body, after, times, in);
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const Lean& from = at[k][axis];
      Wide& to = places[seen[k]].wide[axis];
      places[seen[k]].p[axis] = to.a = from.a;
      to.v.setZero();
      for (int i = 0; i < kFlightParts; ++i)
        if (from.v[i] != 0.0) to.v += from.v[i] * parts[i]->v;
    }
}

void EvaluatedState::PrepareForEvaluation(bool jacobians, bool new_point) {
  if (!new_point && (!jacobians || has_derivatives)) return;
  const std::array<double, kUnknowns> at = unknowns();
  state = unpack<double>(problem, reference, at.data());
  has_derivatives = jacobians;
  for (const SeenOutwards& turning : turnings_) {
    const auto o = static_cast<std::size_t>(turning.body);
    std::vector<double> times;
    for (const std::size_t i : turning.seen) times.push_back(problem.orientations[i].time - state.time);
    const auto ends = turned_through(state.q[o], turning.after ? state.h_after[o] : state.h[o], problem.solids[o].mass.inertia, times, jacobians);
    for (std::size_t k = 0; k < ends.size(); ++k) turned[turning.seen[k]] = ends[k];
  }
  if (jacobians) {
    std::array<Wide, kUnknowns> u;
    u.fill(Wide(0.0));
    for (std::size_t i = 0; i < free.size(); ++i) u[static_cast<std::size_t>(free[i])] = Wide(steps[i], static_cast<int>(i));
    wide = unpack<Wide>(problem, reference, u.data());
  }
  for (const SeenOutwards& flight : flights_) fly(flight, jacobians);
}

std::vector<NamedBlock> add_residuals(const std::optional<Proximity>& touch, EvaluatedState& evaluation, ceres::Problem& ceres) {
  const Problem& problem = evaluation.problem;
  const State& reference = evaluation.reference;
  const Base base{problem, reference};
  const Terms& terms = problem.terms;
  Adder adder(evaluation, ceres);
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const PointObservation& seen = problem.points[i];
    const SeenPlace& place = evaluation.places[i];
    if (problem.noise_power == 2.0)
      adder.add("points", PointTerm{base, seen, place}, new ceres::HuberLoss(kPointHuber));
    else
      for (const int axis : {0, 1}) adder.add("points", FlatPointTerm{base, seen, place, axis}, new SquareLoss);
    if (terms.size && seen.depth > 0.0) adder.add("size", DepthTerm{base, seen, place}, new ceres::HuberLoss(1.0));
  }
  if (terms.size)
    for (const SizeTrend& seen : problem.trends) adder.add("size trend", TrendTerm{base, seen}, new ceres::HuberLoss(1.0));
  if (terms.orientation)
    for (std::size_t i = 0; i < problem.orientations.size(); ++i)
      adder.add("orientation", OrientationTerm{base, problem.orientations[i], evaluation.turned[i]}, new ceres::HuberLoss(kOrientationHuber));
  if (!problem.orientations.empty()) adder.add("spin", SpinTerm{base});
  if (terms.gravity && problem.gravity > 0.0) adder.add("gravity", GravityTerm{base});
  if (terms.gravity && problem.plumb) adder.add("plumb", PlumbTerm{base});
  if (terms.energy) adder.add("energy", EnergyTerm{base});
  if (terms.restitution) adder.add("restitution", RestitutionTerm{base});
  if (touch && reference.law) adder.add("friction", FrictionTerm{base});
  if (touch && reference.law && !problem.fixed && problem.solids[0].is_sphere() && problem.solids[1].is_sphere()) adder.add("slide", SlideTerm{base});
  if (problem.planar) adder.add("planar", PlanarTerm{base});
  if (touch)
    adder.add("touch", TouchTerm{base, *touch, touch_sigma(problem)});
  else
    adder.add("midpoint", MidpointTerm{base});
  for (const OtherContact& other : problem.other_contacts) adder.add("height", HeightTerm{base, other});
  if (terms.soft) {
    constexpr double kWeight = 100.0;  // per m/s: the thesis's 10 against the mean squared error of a hundred centroids known to a third of a pixel
    if (terms.momentum && !problem.fixed) adder.add("momentum", MomentumTerm{base, kWeight});
    if (terms.impulse) adder.add("impulse", ImpulseTerm{base, 0.5 * kWeight});
  }
  return adder.blocks;
}

}  // namespace unseen::collision
