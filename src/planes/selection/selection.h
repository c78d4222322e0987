// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/large_pages.h"
#include "unseen/core/context.h"

namespace unseen::planes {

/// What the pairs of chosen frames cost that have the sum of irregularities `pairs`: that sum, but where frames are many less, so
/// that the cost grows with the frames and not with their pairs. Concave, the least of kIrregularitySlopes straight lines.
double irregularity_cost(double pairs);
struct Line {
  double at_zero, slope;
};
inline constexpr std::array<Line, 5> kIrregularityLines = {{{0, 1}, {4, 1.0 / 2}, {12, 1.0 / 4}, {28, 1.0 / 8}, {60, 1.0 / 16}}};

/// Rows and columns, column by column.
template <class T>
class Table {
 public:
  Table() = default;
  Table(int rows, int cols, T value) : rows_(rows), cols_(cols), values_(static_cast<std::size_t>(rows) * cols, value) {}

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  T& operator()(int row, int col) { return values_[static_cast<std::size_t>(col) * rows_ + row]; }
  const T& operator()(int row, int col) const { return values_[static_cast<std::size_t>(col) * rows_ + row]; }
  /// Overwrites the first rows and columns by those of a smaller table.
  void set_corner(const Table& corner) {
    for (int col = 0; col < corner.cols_; ++col) std::copy_n(&corner(0, col), corner.rows_, &(*this)(0, col));
  }
  template <class F>
  void transform(F f) {
    std::transform(values_.begin(), values_.end(), values_.begin(), f);
  }

 private:
  int rows_ = 0, cols_ = 0;
  LargeVector<T> values_;
};

/// Choice of frames and of one candidate a patch, as numbers: minimise (thesis Eq. 3.4, with Eq. 3.3 linear)
///   λ Σ_j data(j, k_j) + (1−λ) h(Σ_{i<k chosen} irregularity(i,k)) + C · #{neighbours with other orientations}
/// where a frame is chosen if a patch has it, or if it is fixed (chosen in a coarser round); h is irregularity_cost.
struct SelectionProblem {
  double lambda = 0.5;
  Table<double> data;              ///< patches × frames; infinite where a frame has no candidate
  Table<int> orientation;          ///< patches × frames: equal numbers are equal orientations; −1 = no candidate
  Table<double> irregularity;      ///< frames × frames, symmetric, zero diagonal
  std::vector<char> fixed;         ///< per frame
  std::vector<std::pair<int, int>> neighbours;

  int patches() const { return data.rows(); }
  int frames() const { return data.cols(); }
  double of_pairs(double sum) const { return (1.0 - lambda) * irregularity_cost(sum); }
  double smoothness() const { return (1.0 - lambda) / 10.0; }  ///< C
};

struct Energy {
  double data = 0, irregularity = 0, smoothness = 0;  ///< weighted, as they are summed
  double total() const { return data + irregularity + smoothness; }
};

/// What a frame offers a patch: a candidate of cost λ·D. Most pairs of patch and frame have none.
struct Offer {
  int patch;
  double cost;
};
using Offers = std::vector<std::vector<Offer>>;  ///< per frame, patches ascending
Offers offers_of(const SelectionProblem& problem);

using Labels = std::vector<int>;  ///< frame of each patch

Energy energy_of(const SelectionProblem& problem, const Labels& labels);

/// Adds, drops and swaps frames while that lowers data and irregularity, then with labels relaxed by moves of
/// single patches and of connected parts; from several starts, `start` among them if given, and through every
/// subset of the best few frames while the problem is small.
Labels solve_local(const SelectionProblem& problem, const Context& context, const Labels& start = {});

/// A lower bound on the energy of any selection: branch and bound on frames, without the smoothness term,
/// cut off after a fixed amount of work.
double lower_bound(const SelectionProblem& problem, double upper, const Context& context);

struct ExactSolution {
  Labels labels;
  double bound = 0;      ///< proven lower bound on the energy
  bool proven = false;   ///< optimal within the solver's tolerance
};

/// The same as a mixed-integer linear program, by CBC. `start` is a feasible selection.
ExactSolution solve_exact(const SelectionProblem& problem, const Labels& start, double seconds,
                          const Context& context);

}  // namespace unseen::planes
