// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <ClpEventHandler.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "planes/selection/selection.h"

namespace unseen::planes {
namespace {

/// Rows and columns of the program while it is being written down.
struct Program {
  std::vector<double> cost, low, high;
  std::vector<int> integer;
  std::vector<double> row_low, row_high, factors;
  std::vector<int> variables;              // of the factors
  std::vector<CoinBigIndex> starts = {0};  // of rows among the factors

  int variable(double c, bool is_integer) {
    cost.push_back(c);
    low.push_back(0.0);
    high.push_back(1.0);
    if (is_integer) integer.push_back(static_cast<int>(cost.size()) - 1);
    return static_cast<int>(cost.size()) - 1;
  }
  void row(const std::vector<std::pair<int, double>>& terms, double at_least, double at_most) {
    for (const auto& [i, a] : terms) {
      variables.push_back(i);
      factors.push_back(a);
    }
    starts.push_back(static_cast<CoinBigIndex>(factors.size()));
    row_low.push_back(at_least);
    row_high.push_back(at_most);
  }
  CoinPackedMatrix rows() const {
    return {false,
            static_cast<int>(cost.size()),
            static_cast<int>(row_low.size()),
            static_cast<CoinBigIndex>(factors.size()),
            factors.data(),
            variables.data(),
            starts.data(),
            nullptr};
  }
};

struct Variables {
  std::vector<std::map<int, int>> candidate;  // per patch: frame → variable
  std::vector<int> frame;
};

/// The cost of pairs of chosen frames: at least that of one line, whichever the program picks. No selection of less energy than `upper`
/// has pairs for which a line counts that is left out.
void write_irregularity_cost(const SelectionProblem& p, const std::vector<std::pair<int, double>>& pairs, double upper, Program& program) {
  const double affordable = upper / (1.0 - p.lambda);
  double most = 0;  // irregularity that such a selection may have
  for (const Line& line : kIrregularityLines) most = std::max(most, (affordable - line.at_zero) / line.slope);
  std::vector<Line> lines;
  for (const Line& line : kIrregularityLines)
    if (lines.empty() || line.at_zero + line.slope * most < lines.back().at_zero + lines.back().slope * most) lines.push_back(line);
  if (lines.size() == 1) {
    for (const auto& [pair, irregularity] : pairs) program.cost[pair] = (1.0 - p.lambda) * irregularity;
    return;
  }
  const int cost = program.variable(1.0 - p.lambda, false);
  program.high[cost] = affordable;
  std::vector<std::pair<int, double>> one;
  for (const Line& line : lines) {
    const double top = line.at_zero + line.slope * most;  // cost ≥ at_zero + slope·pairs − top (1 − picked)
    one.emplace_back(program.variable(0.0, true), 1.0);
    std::vector<std::pair<int, double>> terms = {{cost, -1.0}, {one.back().first, top}};
    for (const auto& [pair, irregularity] : pairs) terms.emplace_back(pair, line.slope * irregularity);
    program.row(terms, -1e30, top - line.at_zero);
  }
  program.row(one, 1.0, 1.0);
}

Variables write_program(const SelectionProblem& p, double upper, Program& program) {
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
  for (const auto& candidates : v.candidate) {
    std::vector<std::pair<int, double>> one;
    for (const auto& [k, x] : candidates) {
      one.emplace_back(x, 1.0);
      program.row({{x, 1.0}, {v.frame[k], -1.0}}, -kFree, 0.0);  // Eq. 3.3, as x ≤ y
    }
    program.row(one, 1.0, 1.0);
  }
  std::vector<std::pair<int, double>> pairs;  // their sum is what irregularity_cost takes
  for (int a = 0; a < p.frames(); ++a)
    for (int b = 0; b < a; ++b) {
      const double irregularity = p.irregularity(a, b);
      if (irregularity <= 0.0) continue;
      const int both = program.variable(0.0, false);
      program.row({{v.frame[a], 1.0}, {v.frame[b], 1.0}, {both, -1.0}}, -kFree, 1.0);
      pairs.emplace_back(both, irregularity);
    }
  if (p.lambda < 1.0) write_irregularity_cost(p, pairs, upper + 1e-6, program);
  for (const auto& [a, b] : p.neighbours) {
    if (p.smoothness() <= 0.0) break;
    const int differ = program.variable(p.smoothness(), false);
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

/// When the solver must give up: it looks at its own limit of time too rarely.
struct Limit {
  const Context& context;
  std::chrono::steady_clock::time_point end;
  bool reached() const { return context.stop.stop_requested() || std::chrono::steady_clock::now() > end; }
};

/// End the search, and the linear programs within. The solvers copy their handlers.
class LimitedSearch : public CbcEventHandler {
 public:
  explicit LimitedSearch(const Limit& limit) : limit_(limit) {}
  CbcAction event(CbcEvent) override { return limit_.reached() ? stop : noAction; }
  CbcEventHandler* clone() const override { return new LimitedSearch(*this); }

 private:
  Limit limit_;
};

class LimitedProgram : public ClpEventHandler {
 public:
  explicit LimitedProgram(const Limit& limit) : limit_(limit) {}
  int event(Event) override { return limit_.reached() ? 0 : -1; }
  ClpEventHandler* clone() const override { return new LimitedProgram(*this); }

 private:
  Limit limit_;
};

}  // namespace

ExactSolution solve_exact(const SelectionProblem& p, const Labels& start, double seconds,
                          const Context& context) {
  ExactSolution solution;
  solution.labels = start;
  context.check();
  if (p.patches() == 0) {
    solution.bound = energy_of(p, start).total();
    solution.proven = true;
    return solution;
  }
  const Limit limit{context, std::chrono::steady_clock::now() +
                                 std::chrono::milliseconds(static_cast<long>(1e3 * std::min(seconds, 1e9)))};
  Program program;
  const double upper = energy_of(p, start).total();
  const Variables v = write_program(p, upper, program);
  OsiClpSolverInterface clp;
  clp.messageHandler()->setLogLevel(0);
  clp.loadProblem(program.rows(), program.low.data(), program.high.data(), program.cost.data(),
                  program.row_low.data(), program.row_high.data());
  for (const int i : program.integer) clp.setInteger(i);
  LimitedProgram limited_program(limit);
  clp.getModelPtr()->passInEventHandler(&limited_program);
  CbcModel model(clp);
  LimitedSearch limited_search(limit);
  model.passInEventHandler(&limited_search);
  model.messageHandler()->setLogLevel(0);
  model.solver()->messageHandler()->setLogLevel(0);
  model.setLogLevel(0);
  model.setMaximumSeconds(seconds);
  model.setAllowableFractionGap(1e-6);
  model.setCutoff(upper + 1e-6);
  model.branchAndBound();
  context.check();
  solution.proven = !limit.reached() && (model.isProvenOptimal() || model.isProvenInfeasible());
  solution.bound = !solution.proven ? lower_bound(p, upper, context)  // an interrupted program has none
                   : model.isProvenOptimal() ? std::min(upper, model.getObjValue())
                                             : upper;
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
