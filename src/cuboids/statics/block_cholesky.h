// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

namespace unseen::cuboids {

/// Cholesky factorisation of a sparse symmetric matrix of 6×6 blocks, one row of blocks a body and one block a pair
/// of bodies that touch. Eliminates bodies in order of fewest neighbours, so that walls and piles fill in little.
/// The pattern is analysed once; the numbers may change often.
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;

  /// `pairs` of different rows; a pair may occur more than once.
  BlockCholesky(int rows, std::span<const std::pair<int, int>> pairs);

  void set_identity();
  Block& diagonal(int row) { return diagonal_[place_[row]]; }
  /// The block of pair number `pair`: row pairs[pair].first, column .second, or its transpose if is_transposed(pair).
  Block& below(int pair) { return below_[block_of_pair_[pair]]; }
  bool is_transposed(int pair) const { return transposed_[pair]; }

  /// Overwrites the matrix; false if it is not positive definite.
  bool factor();
  /// Replaces the right-hand side by the solution.
  void solve(Eigen::VectorXd& x) const;

 private:
  std::vector<int> place_;  ///< of a row in the order of elimination
  std::vector<int> start_;  ///< of each column's blocks in row_ and below_
  std::vector<int> row_;    ///< place of each block's row
  std::vector<int> target_;  ///< blocks changed by eliminating each column, −1 − place for a diagonal one
  std::vector<int> block_of_pair_;
  std::vector<char> transposed_;
  std::vector<Block> diagonal_, below_;  ///< after factor(): inverse of the factor's diagonal blocks, and the factor
};

}  // namespace unseen::cuboids
