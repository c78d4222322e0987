// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kParallel = 0.99;       // cosine between a face's normal and that of a contact
constexpr double kClosable = 2.0;        // tolerances
constexpr double kHiddenFreedom = 100.0; // variance of a face that was moved, against 1 of a seen one

/// The face of a box that a contact with outward normal `n` acts on; none if it is an edge or a vertex.
std::optional<int> face_towards(const OrientedBox& box, const Vec3& n) {
  for (int face = 0; face < 6; ++face)
    if (face_normal(box, face).dot(n) > kParallel) return face;
  return std::nullopt;
}

}  // namespace

void close_contacts(const Problem& problem, const std::vector<Touch>& touches, Arrangement& arrangement) {
  const int variables = 6 * static_cast<int>(problem.cuboids.size());
  const auto index = [&](int body, int face) { return 6 * (body - problem.supports_count()) + face; };
  Eigen::VectorXd variance = Eigen::VectorXd::Ones(variables);
  for (std::size_t i = 0; i < arrangement.boxes.size(); ++i)
    for (int face = 0; face < 6; ++face)
      if (arrangement.extension[i][face] > 0.0) variance[6 * i + face] = kHiddenFreedom;

  // One row a contact: the two faces together must move by the gap.
  std::vector<std::array<int, 2>> rows;
  std::vector<double> gaps;
  for (const Touch& touch : touches) {
    const Vec3& n = touch.interface.normal;
    const auto on_b = face_towards(arrangement.boxes[touch.b - problem.supports_count()], -n);
    const auto on_a = problem.is_support(touch.a) ? std::nullopt : face_towards(arrangement.boxes[touch.a - problem.supports_count()], n);
    if (!on_b || (!problem.is_support(touch.a) && !on_a)) continue;
    if (touch.interface.gap > kClosable * problem.pair_tolerance(touch.a, touch.b)) continue;
    rows.push_back({on_a ? index(touch.a, *on_a) : -1, index(touch.b, *on_b)});
    gaps.push_back(touch.interface.gap);
  }
  if (rows.empty()) return;
  const int count = static_cast<int>(rows.size());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(variables, count);  // variance · rowsᵀ
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  for (int r = 0; r < count; ++r)
    for (const int v : rows[r])
      if (v >= 0) spread(v, r) = variance[v];
  for (int r = 0; r < count; ++r)
    for (const int v : rows[r])
      if (v >= 0) normal.row(r) += spread.row(v);
  normal.diagonal().array() += 1e-6;  // contacts that contradict each other share the rest
  const Eigen::VectorXd moves = spread * normal.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(gaps.data(), count));
  double volume = 0.0;
  for (std::size_t i = 0; i < arrangement.boxes.size(); ++i) {
    Extension extension;
    for (int face = 0; face < 6; ++face)
      extension[face] = std::max(moves[6 * i + face], -kMostShrink * 2.0 * problem.cuboids[i].initial.half_size[face / 2] -
                                                          arrangement.extension[i][face]);
    arrangement.boxes[i] = extended(arrangement.boxes[i], extension);
    arrangement.solids[i] = solid_of(arrangement.boxes[i]);
    for (int face = 0; face < 6; ++face) arrangement.extension[i][face] += extension[face];
    volume += arrangement.boxes[i].volume() - problem.cuboids[i].initial.volume();
  }
  arrangement.extended_volume = volume;
}

}  // namespace unseen::cuboids
