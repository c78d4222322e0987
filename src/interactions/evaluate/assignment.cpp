// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/evaluate/assignment.h"

#include <algorithm>
#include <limits>

namespace unseen::interactions {
namespace {

/// Least-cost assignment of every row of a matrix that has no more rows than columns: shortest augmenting paths with potentials.
/// Row and column 0 of the working arrays are a dummy from which each search starts.
std::vector<int> assign_all(const Eigen::MatrixXd& cost) {
  const Eigen::Index rows = cost.rows(), columns = cost.cols();
  std::vector<double> u(static_cast<std::size_t>(rows + 1)), v(static_cast<std::size_t>(columns + 1));
  std::vector<Eigen::Index> row_of(v.size(), 0), from(v.size(), 0);
  for (Eigen::Index row = 1; row <= rows; ++row) {
    std::vector<double> least(v.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> used(v.size(), false);
    std::size_t at = 0;
    row_of[0] = row;
    do {
      used[at] = true;
      const Eigen::Index r = row_of[at];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c < v.size(); ++c) {
        if (used[c]) continue;
        const double reduced = cost(r - 1, static_cast<Eigen::Index>(c) - 1) - u[static_cast<std::size_t>(r)] - v[c];
        if (reduced < least[c]) least[c] = reduced, from[c] = static_cast<Eigen::Index>(at);
        if (least[c] < step) step = least[c], next = c;
      }
      for (std::size_t c = 0; c < v.size(); ++c) {
        if (used[c]) u[static_cast<std::size_t>(row_of[c])] += step, v[c] -= step;
        else least[c] -= step;
      }
      at = next;
    } while (row_of[at] != 0);
    for (std::size_t before = 0; at != 0; at = before) {
      before = static_cast<std::size_t>(from[at]);
      row_of[at] = row_of[before];
    }
  }
  std::vector<int> column_of(static_cast<std::size_t>(rows), -1);
  for (std::size_t c = 1; c < v.size(); ++c)
    if (row_of[c] != 0) column_of[static_cast<std::size_t>(row_of[c] - 1)] = static_cast<int>(c) - 1;
  return column_of;
}

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double gate) {
  if (cost.size() == 0) return std::vector<int>(static_cast<std::size_t>(cost.rows()), -1);
  // Any pair beyond the gate, or none at all, costs more than all good pairs together; each row has a column for "none".
  const double none = (gate + 1.0) * static_cast<double>(std::min(cost.rows(), cost.cols()) + 1);
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(cost.rows(), cost.cols() + cost.rows(), none);
  all.leftCols(cost.cols()) = (cost.array() <= gate).select(cost, none);
  std::vector<int> columns = assign_all(all);
  for (std::size_t r = 0; r < columns.size(); ++r)
    if (columns[r] >= cost.cols() || !(cost(static_cast<Eigen::Index>(r), columns[r]) <= gate)) columns[r] = -1;
  return columns;
}

}  // namespace unseen::interactions
