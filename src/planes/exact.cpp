// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <CbcModel.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <cmath>
#include <map>
#include <set>

#include "planes/selection.h"

namespace unseen::planes {
namespace {

/// Rows and columns of the program while it is being written down.
struct Program {
  std::vector<double> cost, low, high;
  std::vector<int> integer;
  CoinPackedMatrix rows{false, 0, 0};
  std::vector<double> row_low, row_high;

  int variable(double c, bool is_integer) {
    cost.push_back(c);
    low.push_back(0.0);
    high.push_back(1.0);
    if (is_integer) integer.push_back(static_cast<int>(cost.size()) - 1);
    return static_cast<int>(cost.size()) - 1;
  }
  void row(const std::vector<std::pair<int, double>>& terms, double at_least, double at_most) {
    CoinPackedVector v;
    for (const auto& [i, a] : terms) v.insert(i, a);
    rows.appendRow(v);
    row_low.push_back(at_least);
    row_high.push_back(at_most);
  }
};

struct Variables {
  std::vector<std::map<int, int>> candidate;  // per patch: frame → variable
  std::vector<int> frame;
};

Variables write_program(const SelectionProblem& p, Program& program) {
  constexpr double kFree = 1e30;
  Variables v;
  for (int k = 0; k < p.frames(); ++k) {
    v.frame.push_back(program.variable(0.0, true));
    if (p.fixed[k]) program.low[v.frame[k]] = 1.0;
  }
  v.candidate.resize(p.patches());
  for (int j = 0; j < p.patches(); ++j)
    for (int k = 0; k < p.frames(); ++k)
      if (std::isfinite(p.data(j, k))) v.candidate[j][k] = program.variable(p.lambda * p.data(j, k), true);
  program.rows.setDimensions(0, static_cast<int>(program.cost.size()));
  for (const auto& candidates : v.candidate) {
    std::vector<std::pair<int, double>> one;
    for (const auto& [k, x] : candidates) {
      one.emplace_back(x, 1.0);
      program.row({{x, 1.0}, {v.frame[k], -1.0}}, -kFree, 0.0);  // Eq. 3.3, as x ≤ y
    }
    program.row(one, 1.0, 1.0);
  }
  for (int a = 0; a < p.frames(); ++a)
    for (int b = 0; b < a; ++b) {
      const double cost = (1.0 - p.lambda) * p.irregularity(a, b);
      if (cost <= 0.0) continue;
      const int both = program.variable(cost, false);
      program.rows.setDimensions(-1, static_cast<int>(program.cost.size()));
      program.row({{v.frame[a], 1.0}, {v.frame[b], 1.0}, {both, -1.0}}, -kFree, 1.0);
    }
  for (const auto& [a, b] : p.neighbours) {
    if (p.smoothness() <= 0.0) break;
    const int differ = program.variable(p.smoothness(), false);
    program.rows.setDimensions(-1, static_cast<int>(program.cost.size()));
    std::set<int> orientations;
    for (const auto& [k, x] : v.candidate[a]) orientations.insert(p.orientation(a, k));
    for (const int o : orientations) {
      std::vector<std::pair<int, double>> terms = {{differ, -1.0}};
      for (const auto& [k, x] : v.candidate[a])
        if (p.orientation(a, k) == o) terms.emplace_back(x, 1.0);
      for (const auto& [k, x] : v.candidate[b])
        if (p.orientation(b, k) == o) terms.emplace_back(x, -1.0);
      program.row(terms, -kFree, 0.0);
    }
  }
  return v;
}

}  // namespace

ExactSolution solve_exact(const SelectionProblem& p, const Labels& start, double seconds, const Context& context) {
  ExactSolution solution;
  solution.labels = start;
  context.check();
  if (p.patches() == 0) {
    solution.bound = energy_of(p, start).total();
    solution.proven = true;
    return solution;
  }
  Program program;
  const Variables v = write_program(p, program);
  OsiClpSolverInterface clp;
  clp.messageHandler()->setLogLevel(0);
  clp.loadProblem(program.rows, program.low.data(), program.high.data(), program.cost.data(),
                  program.row_low.data(), program.row_high.data());
  for (const int i : program.integer) clp.setInteger(i);
  CbcModel model(clp);
  model.messageHandler()->setLogLevel(0);
  model.solver()->messageHandler()->setLogLevel(0);
  model.setLogLevel(0);
  model.setMaximumSeconds(seconds);
  model.setAllowableFractionGap(1e-6);
  const double upper = energy_of(p, start).total();
  model.setCutoff(upper + 1e-6);
  model.branchAndBound();
  solution.bound = std::min(upper, model.getBestPossibleObjValue());
  solution.proven = model.isProvenOptimal() || model.isProvenInfeasible();
  if (solution.proven) solution.bound = std::min(upper, model.isProvenOptimal() ? model.getObjValue() : upper);
  if (const double* x = model.bestSolution()) {
    Labels labels = start;
    for (int j = 0; j < p.patches(); ++j)
      for (const auto& [k, variable] : v.candidate[j])
        if (x[variable] > 0.5) labels[j] = k;
    if (energy_of(p, labels).total() < upper) solution.labels = labels;
  }
  return solution;
}

}  // namespace unseen::planes
