// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/linear.h"
#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kTowards = 0.7;         // cosine between a face's normal and that of a contact
constexpr double kClosable = 2.0;        // tolerances
constexpr double kFarthestMove = 2.0;    // of the widest gap: no face needs more to close its own
constexpr double kLeastFreedom = 1e-6, kMostFreedom = 1e3;  // variance of a contact
constexpr double kHiddenFreedom = 100.0; // variance of a face that was moved, against 1 of a seen one

/// A variable of a row, and how far it moves the contact.
struct Part {
  int variable = -1;
  double cosine = 0;
};

/// The face of a box that looks most along the outward normal `n` of a contact, which may be at its edge or corner.
std::optional<Part> face_towards(const OrientedBox& box, const Vec3& n, int first_variable) {
  for (int face = 0; face < 6; ++face)
    if (const double cosine = face_normal(box, face).dot(n); cosine > kTowards) return Part{first_variable + face, cosine};
  return std::nullopt;
}

}  // namespace

void close_contacts(const Problem& problem, const std::vector<Touch>& touches, Arrangement& arrangement) {
  const int variables = 6 * static_cast<int>(problem.cuboids.size());
  Eigen::VectorXd variance = Eigen::VectorXd::Ones(variables);
  for (std::size_t i = 0; i < arrangement.boxes.size(); ++i)
    for (int face = 0; face < 6; ++face)
      if (arrangement.extension[i][face] > 0.0) variance[6 * i + face] = kHiddenFreedom;

  // One row a contact: the two faces together must move by the gap.
  std::vector<std::array<Part, 2>> rows;
  std::vector<double> gaps;
  for (const Touch& touch : touches) {
    const Vec3& n = touch.interface.normal;
    const auto face_of = [&](int body, const Vec3& outward) -> std::optional<Part> {
      const int i = body - problem.supports_count();
      return i < 0 ? Part{} : face_towards(arrangement.boxes[i], outward, 6 * i);
    };
    const auto on_a = face_of(touch.a, n), on_b = face_of(touch.b, -n);
    if (!on_a || !on_b) continue;
    if (std::abs(touch.interface.gap) > kClosable * problem.pair_tolerance(touch.a, touch.b)) continue;
    rows.push_back({*on_a, *on_b});
    gaps.push_back(touch.interface.gap);
  }
  if (rows.empty()) return;
  const int count = static_cast<int>(rows.size());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(variables, count);  // variance · rowsᵀ
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  for (int r = 0; r < count; ++r)
    for (const Part& part : rows[r])
      if (part.variable >= 0) spread(part.variable, r) = part.cosine * variance[part.variable];
  for (int r = 0; r < count; ++r)
    for (const Part& part : rows[r])
      if (part.variable >= 0) normal.row(r) += part.cosine * spread.row(part.variable);
  // Contacts that contradict each other share the rest. Where their normals are nearly the same, but not quite, that takes more freedom, or faces run far off.
  const Eigen::Map<const Eigen::VectorXd> wanted(gaps.data(), count);
  Eigen::VectorXd moves;
  for (double freedom = kLeastFreedom; freedom < kMostFreedom; freedom *= 10.0) {
    Eigen::MatrixXd free = normal;
    free.diagonal().array() += freedom;
    moves = spread * solve_symmetric(free, wanted);
    if (moves.cwiseAbs().maxCoeff() <= kFarthestMove * wanted.cwiseAbs().maxCoeff()) break;
  }
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
