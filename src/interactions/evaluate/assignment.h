// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace unseen::interactions {

/// One-to-one assignment of rows to columns: first as many pairs as possible of those whose cost is at most `gate`, then the least sum
/// of costs (≥ 0). The column of each row, −1 without one. Exact (Kuhn 1955, Jonker and Volgenant 1987), cubic in the larger side.
std::vector<int> assign(const Eigen::MatrixXd& cost, double gate);

}  // namespace unseen::interactions
