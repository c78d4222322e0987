// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/contact_loads.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

/// Conductance of each body to what is static, where a contact has 1: for bodies that nothing carries.
constexpr double kLeak = 1e-6;

}  // namespace

std::vector<double> contact_loads(std::span<const Body> bodies, std::span<const ContactPoint> contacts) {
  const auto count = static_cast<Eigen::Index>(bodies.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd potential = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    entries.emplace_back(i, i, bodies[i].is_static ? 1.0 : kLeak);
    if (!bodies[i].is_static) potential[i] = bodies[i].weight;
  }
  for (const ContactPoint& c : contacts) {
    if (!bodies[c.a].is_static) entries.emplace_back(c.a, c.a, 1.0);
    if (!bodies[c.b].is_static) entries.emplace_back(c.b, c.b, 1.0);
    if (!bodies[c.a].is_static && !bodies[c.b].is_static)
      entries.emplace_back(std::max(c.a, c.b), std::min(c.a, c.b), -1.0);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  potential = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(potential);
  std::vector<double> loads;
  for (const ContactPoint& c : contacts) loads.push_back(std::abs(potential[c.a] - potential[c.b]));
  return loads;
}

}  // namespace unseen::cuboids
