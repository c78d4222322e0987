// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
//
// Minimises ½‖Df + w‖² over a product of friction cones by the proximal method of multipliers: round k minimises
//   ψ(r) = ½‖r‖² − r·w + ‖Π(f − σDᵀr)‖² / 2σ,   Π = projection on the cones,
// over the residual r alone, by Newton's method with the generalised Jacobian of Π (Qi & Sun, "A nonsmooth version of
// Newton's method", 1993; Rockafellar, "Augmented Lagrangians and applications of the proximal point algorithm", 1976),
// and then replaces f by that projection. The matrix I + σ D Π' Dᵀ has a 6×6 block a body and a pair that touches, so
// a step costs little more than looking at each contact, however many of them press. The round cone needs no polygon.
// Forces count in units of the load that may pass, or a light body would hardly come to bear a heavy one.
#include <algorithm>
#include <cmath>

#include "cuboids/statics/block_cholesky.h"
#include "cuboids/statics/cone_contacts.h"
#include "cuboids/statics/friction_cone.h"
#include "cuboids/statics/statics.h"

namespace unseen::cuboids {
namespace {

constexpr double kFirstSigma = 100.0, kSigmaGrowth = 10.0, kLargestSigma = 1e5;
constexpr int kSteps = 200, kTries = 200;
constexpr double kBalanced = 1e-11;  ///< residual
constexpr double kMinimal = 1e-12;   ///< gradient of ψ, at least; per σ, what rounding leaves
constexpr double kRounding = 1e-15;
constexpr double kRough = 1e-2;      ///< share of a round's change in f/σ to which it need be solved

using Vector = Eigen::VectorXd;

double largest_part(const Vector& r) {
  double largest = 0;
  for (Eigen::Index i = 0; i < r.size(); i += 3) largest = std::max(largest, r.segment<3>(i).norm());
  return largest;
}

Vec3 felt_by(const ConeContact& c, const Vector& r) {  // Dᵀr
  Vec3 sum = Vec3::Zero();
  for (const Lever& l : c.lever)
    if (l.body >= 0)
      sum += l.scale * (r.segment<3>(6 * l.body) + Vec3(r.segment<3>(6 * l.body + 3)).cross(l.arm));
  return sum;
}

void add_force(const ConeContact& c, const Vec3& force, Vector& r) {  // r += Df
  for (const Lever& l : c.lever)
    if (l.body >= 0) {
      r.segment<3>(6 * l.body) += l.scale * force;
      r.segment<3>(6 * l.body + 3) += l.scale * l.arm.cross(force);
    }
}

BlockCholesky::Block block_of(const Lever& a, const Lever& b, const Mat3& m, const Mat3& cross_a, const Mat3& cross_b) {
  BlockCholesky::Block block;
  const Mat3 left = cross_a * m, right = m * cross_b.transpose();
  block << m, right, left, cross_a * right;
  return a.scale * b.scale * block;
}

class Solver {
 public:
  Solver(const Component& component, const Vec3& gravity, const Context& context)
      : context_(context), contacts_(component.contacts), matrix_(static_cast<int>(component.bodies.size()), component.pairs),
        load_(6 * component.bodies.size()), force_(contacts_.size(), Vec3::Zero()), next_(contacts_.size()) {
    for (std::size_t i = 0; i < component.bodies.size(); ++i) load_.segment<6>(6 * i) << gravity, Vec3::Zero();
  }

  void start_from(std::span<const Vec3> forces) {
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      force_[c] = project_to_cone(forces[contacts_[c].index] / contacts_[c].unit, contacts_[c].normal,
                                  contacts_[c].friction).force;
  }

  /// Returns the residual Df + w; forces() and motion() then hold f and what r came to. The two differ by what is left
  /// of the gradient, which only the residual counts; of light bodies under heavy ones only r tells the motion.
  Vector solve(const Effort& effort) {
    Vector exact = residual_of(force_);
    Vector& r = motion_ = exact;
    double sigma = kFirstSigma;
    for (int round = 0; round < effort.rounds; ++round) {
      minimise(r, sigma);
      double size = 0;
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        size += next_[c].force.squaredNorm();
        force_[c] = next_[c].force;
      }
      exact = residual_of(force_);
      // Dᵀr misses the dual cone by change/σ at most, so ‖r‖² is that much times ‖f‖ from its least value.
      const double miss = std::sqrt(change_ * size) / sigma;
      if (largest_part(exact) < std::max(kBalanced, effort.enough) || miss <= effort.certain * exact.squaredNorm()) break;
      sigma = std::min(sigma * kSigmaGrowth, kLargestSigma);
    }
    return exact;
  }

  const std::vector<Vec3>& forces() const { return force_; }
  const Vector& motion() const { return motion_; }

 private:
  Vector residual_of(const std::vector<Vec3>& forces) const {
    Vector r = load_;
    for (std::size_t c = 0; c < contacts_.size(); ++c) add_force(contacts_[c], forces[c], r);
    return r;
  }

  /// Sets `gradient` to that of ψ at r, next_ to the projections, change_ to their squared distance from force_.
  void evaluate(const Vector& r, double sigma, Vector& gradient) {
    gradient = r - load_;
    change_ = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const ConeContact& k = contacts_[c];
      next_[c] = project_to_cone(force_[c] - sigma * felt_by(k, r), k.normal, k.friction);
      change_ += (next_[c].force - force_[c]).squaredNorm();
      if (next_[c].is_zero) continue;
      add_force(k, -next_[c].force, gradient);
    }
  }

  void assemble(double sigma) {
    matrix_.set_identity();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (next_[c].is_zero) continue;
      const ConeContact& k = contacts_[c];
      const Mat3 m = sigma * next_[c].derivative;
      const Mat3 cross[2] = {cross_matrix(k.lever[0].arm), cross_matrix(k.lever[1].arm)};
      for (int i = 0; i < 2; ++i)
        if (k.lever[i].body >= 0)
          matrix_.diagonal(k.lever[i].body) += block_of(k.lever[i], k.lever[i], m, cross[i], cross[i]);
      if (k.pair < 0) continue;
      const int i = matrix_.is_transposed(k.pair) ? 1 : 0;
      matrix_.below(k.pair) += block_of(k.lever[i], k.lever[1 - i], m, cross[i], cross[1 - i]);
    }
  }

  void minimise(Vector& r, double sigma) {
    Vector gradient(r.size()), step(r.size());
    evaluate(r, sigma, gradient);
    const double rounding = std::max(kMinimal, kRounding * sigma);
    for (int i = 0; i < kSteps; ++i) {
      if (gradient.norm() <= std::max(rounding, kRough * std::sqrt(change_) / sigma)) break;
      context_.check();
      assemble(sigma);
      if (!matrix_.factor()) break;
      step = -gradient;
      matrix_.solve(step);
      if (!walk(r, step, sigma, gradient)) break;
    }
  }

  /// Goes along a step to where ψ rises or falls less than half as steeply as at first; false if rounding hides where.
  /// ψ is convex with sharp bends, some 10⁵ to 10¹⁰ times as steep on one side, so halving a whole step would not get there.
  bool walk(Vector& r, const Vector& step, double sigma, Vector& gradient) {
    const double first = gradient.dot(step);
    double low = 0.0, low_slope = first, high = 1.0, high_slope = 0.0, at = 1.0;
    int side = 0;
    for (int i = 0; i < kTries; ++i) {
      evaluate(r + at * step, sigma, gradient);
      const double slope = gradient.dot(step);
      if (std::abs(slope) <= -0.5 * first || (i == 0 && slope < 0.0)) {
        r += at * step;
        return true;
      }
      // The end that stays counts half from its second time on (Dowell & Jarratt's Illinois method).
      if (slope < 0.0) {
        if (side < 0) high_slope *= 0.5;
        low = at;
        low_slope = slope;
        side = -1;
      } else {
        if (side > 0) low_slope *= 0.5;
        high = at;
        high_slope = slope;
        side = 1;
      }
      at = low - low_slope * (high - low) / (high_slope - low_slope);
      // A secant alone creeps towards a bend.
      if (i % 3 == 2 || !(at > low && at < high)) at = 0.5 * (low + high);
    }
    evaluate(r, sigma, gradient);
    return false;
  }

  const Context& context_;
  const std::vector<ConeContact>& contacts_;
  BlockCholesky matrix_;
  Vector load_, motion_;
  std::vector<Vec3> force_;
  std::vector<ConeProjection> next_;
  double change_ = 0;
};

}  // namespace

Balance balance(std::span<const Body> bodies, std::span<const ContactPoint> contacts, const Vec3& gravity,
                std::span<const Vec3> start, const Effort& effort, const Context& context) {
  Balance result;
  result.forces.assign(contacts.size(), Vec3::Zero());
  result.motion.assign(bodies.size(), Vec6::Zero());
  for (const Component& component : components_of(bodies, contacts)) {
    Solver solver(component, gravity, context);
    if (start.size() == contacts.size()) solver.start_from(start);
    result.residual = std::max(result.residual, largest_part(solver.solve(effort)));
    for (std::size_t i = 0; i < component.bodies.size(); ++i)
      result.motion[component.bodies[i]] = solver.motion().segment<6>(6 * i);
    for (std::size_t c = 0; c < component.contacts.size(); ++c)
      result.forces[component.contacts[c].index] = component.contacts[c].unit * solver.forces()[c];
  }
  return result;
}

}  // namespace unseen::cuboids
