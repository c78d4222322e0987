// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/block_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

namespace unseen::cuboids {
namespace {

/// Rows in the order of fewest neighbours, and the neighbours that each has left when it goes.
struct Elimination {
  std::vector<int> order;
  std::vector<std::set<int>> left;
};

Elimination eliminate(int rows, std::span<const std::pair<int, int>> pairs) {
  std::vector<std::set<int>> neighbours(rows);
  for (const auto& [a, b] : pairs) {
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  Elimination result;
  std::vector<char> gone(rows, 0);
  for (int step = 0; step < rows; ++step) {
    int best = -1;
    for (int i = 0; i < rows; ++i)
      if (!gone[i] && (best < 0 || neighbours[i].size() < neighbours[best].size())) best = i;
    gone[best] = 1;
    for (const int i : neighbours[best]) {
      neighbours[i].erase(best);
      for (const int k : neighbours[best])
        if (k != i) neighbours[i].insert(k);
    }
    result.order.push_back(best);
    result.left.push_back(std::move(neighbours[best]));
    neighbours[best].clear();
  }
  return result;
}

}  // namespace

BlockCholesky::BlockCholesky(int rows, std::span<const std::pair<int, int>> pairs)
    : place_(rows), start_{0}, diagonal_(rows) {
  const Elimination elimination = eliminate(rows, pairs);
  for (int i = 0; i < rows; ++i) place_[elimination.order[i]] = i;
  for (int column = 0; column < rows; ++column) {
    std::vector<int> places;
    for (const int i : elimination.left[column]) places.push_back(place_[i]);
    std::sort(places.begin(), places.end());
    row_.insert(row_.end(), places.begin(), places.end());
    start_.push_back(static_cast<int>(row_.size()));
  }
  below_.resize(row_.size());
  const auto block_at = [&](int row, int column) {
    const auto first = row_.begin() + start_[column], last = row_.begin() + start_[column + 1];
    return static_cast<int>(std::lower_bound(first, last, row) - row_.begin());
  };
  for (const auto& [a, b] : pairs) {
    const int row = std::max(place_[a], place_[b]), column = std::min(place_[a], place_[b]);
    block_of_pair_.push_back(block_at(row, column));
    transposed_.push_back(place_[a] < place_[b]);
  }
  for (int column = 0; column < rows; ++column)
    for (int i = start_[column]; i < start_[column + 1]; ++i)
      for (int k = start_[column]; k <= i; ++k)
        target_.push_back(i == k ? -1 - row_[i] : block_at(row_[i], row_[k]));
}

void BlockCholesky::set_identity() {
  for (Block& block : diagonal_) block.setIdentity();
  for (Block& block : below_) block.setZero();
}

bool BlockCholesky::factor() {
  auto target = target_.begin();
  Eigen::LLT<Block> llt;
  for (std::size_t column = 0; column < diagonal_.size(); ++column) {
    llt.compute(diagonal_[column]);
    if (llt.info() != Eigen::Success) return false;
    Block inverse = Block::Identity();
    llt.matrixL().solveInPlace(inverse);
    diagonal_[column] = inverse;
    for (int i = start_[column]; i < start_[column + 1]; ++i) {
      const Block scaled = below_[i] * inverse.transpose();
      below_[i] = scaled;
      for (int k = start_[column]; k <= i; ++k, ++target) {
        Block& changed = *target < 0 ? diagonal_[-1 - *target] : below_[*target];
        changed.noalias() -= scaled * below_[k].transpose();
      }
    }
  }
  return true;
}

void BlockCholesky::solve(Eigen::VectorXd& x) const {
  const int rows = static_cast<int>(diagonal_.size());
  Eigen::VectorXd y(x.size());
  for (std::size_t i = 0; i < place_.size(); ++i) y.segment<6>(6 * place_[i]) = x.segment<6>(6 * i);
  for (int column = 0; column < rows; ++column) {
    const Eigen::Matrix<double, 6, 1> part = diagonal_[column] * y.segment<6>(6 * column);
    y.segment<6>(6 * column) = part;
    for (int i = start_[column]; i < start_[column + 1]; ++i) y.segment<6>(6 * row_[i]).noalias() -= below_[i] * part;
  }
  for (int column = rows - 1; column >= 0; --column) {
    Eigen::Matrix<double, 6, 1> part = y.segment<6>(6 * column);
    for (int i = start_[column]; i < start_[column + 1]; ++i)
      part.noalias() -= below_[i].transpose() * y.segment<6>(6 * row_[i]);
    y.segment<6>(6 * column) = diagonal_[column].transpose() * part;
  }
  for (std::size_t i = 0; i < place_.size(); ++i) x.segment<6>(6 * i) = y.segment<6>(6 * place_[i]);
}

}  // namespace unseen::cuboids
