// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "cuboids/collapse.h"

namespace unseen::cuboids {
namespace {

constexpr double kSameVolume = 1e-9;  // m³
constexpr Cost kNoCost = {std::numeric_limits<int>::max(), std::numeric_limits<double>::infinity()};

/// A collapse, and the hypotheses of which every arrangement that stands has at least one (if it collapses the initial
/// arrangement; else that has to be worked out where it is met).
struct Certificate {
  Collapse collapse;
  bool of_initial = false;
  std::vector<int> cut;
};

/// An option of a branch, with what the arrangement would cost.
struct Option {
  int hypothesis = -1;
  Cost cost;
};

struct Search {
  const Problem& problem;
  const Admissible& admissible;
  Context& context;
  std::chrono::steady_clock::time_point end;
  Arrangement initial, largest;
  std::vector<Touch> initial_touches;
  std::vector<char> held;
  std::vector<Certificate> known;
  std::vector<int> blame;  ///< a body: in how many dead ends it was on the move
  Choice best;
  bool found = false;
};

Cost cost_of(const Arrangement& a) { return {static_cast<int>(a.fixed.size()), a.extended_volume}; }
Cost operator+(const Cost& a, const Cost& b) { return {a.fixed + b.fixed, a.volume + b.volume}; }

std::vector<int> with(std::vector<int> chosen, int h) {
  chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), h), h);
  return chosen;
}

/// Every face moved as far as any hypothesis asks.
Arrangement largest_arrangement(const Problem& problem) {
  std::vector<int> all(problem.hypotheses.size());
  for (std::size_t h = 0; h < all.size(); ++h) all[h] = static_cast<int>(h);
  Arrangement a = arrange(problem, all);
  a.fixed.clear();
  return a;
}

Certificate certificate_of(const Search& s, Collapse collapse) {
  Certificate c{std::move(collapse), false, {}};
  c.of_initial = proven_residual(c.collapse, s.problem, s.initial, s.initial_touches, s.held) >= s.problem.stable_residual;
  if (c.of_initial) c.cut = remedies(c.collapse, s.problem, s.initial, s.largest, s.held);
  return c;
}

/// What is known against an arrangement.
struct Verdict {
  bool stands = false;
  double residual = 0;
  std::vector<int> certificates;  ///< indices into Search::known
};

Verdict judge(Search& s, const Arrangement& now) {
  const std::vector<Touch> touches = touching_pairs(s.problem, now);
  Verdict verdict;
  for (std::size_t c = 0; c < s.known.size(); ++c)
    if (proven_residual(s.known[c].collapse, s.problem, now, touches, s.held) >= s.problem.stable_residual)
      verdict.certificates.push_back(static_cast<int>(c));
  if (!verdict.certificates.empty()) return verdict;
  const Structure structure = structure_of(s.problem, now, touches, s.held);
  const Balance b = balance(structure.bodies, structure.contacts);
  verdict.residual = b.residual;
  verdict.stands = b.residual < s.problem.stable_residual;
  if (verdict.stands) return verdict;
  for (Collapse& collapse : collapses_of(b, structure, s.problem, now, touches, s.held)) {
    verdict.certificates.push_back(static_cast<int>(s.known.size()));
    s.known.push_back(certificate_of(s, std::move(collapse)));
  }
  return verdict;
}

/// The open hypotheses of a cut, the cheapest first.
std::vector<Option> options_of(const Search& s, const std::vector<int>& cut, const Arrangement& now,
                               const std::vector<char>& closed) {
  std::vector<Option> out;
  for (const int h : cut) {
    if (closed[h]) continue;
    const Hypothesis& hypothesis = s.problem.hypotheses[h];
    const Cost added = {hypothesis.kind == ContactKind::fixed ? 1 : 0, added_volume(s.problem, now, hypothesis)};
    out.push_back({h, cost_of(now) + added});
  }
  std::stable_sort(out.begin(), out.end(), [](const Option& a, const Option& b) { return cheaper(a.cost, b.cost); });
  return out;
}

std::vector<int> cut_of(const Search& s, const Certificate& c, const Arrangement& now, const std::vector<int>& chosen) {
  const bool fresh = std::none_of(c.cut.begin(), c.cut.end(),
                                  [&](int h) { return std::binary_search(chosen.begin(), chosen.end(), h); });
  return c.of_initial && fresh ? c.cut : remedies(c.collapse, s.problem, now, s.largest, s.held);
}

/// What an arrangement costs at least once all collapses are stopped: cuts that share no hypothesis and move no body in
/// common add up.
Cost lower_bound(const Search& s, const Arrangement& now, const std::vector<std::vector<Option>>& branches) {
  Cost bound = cost_of(now);
  std::vector<char> used(s.problem.hypotheses.size(), 0), moved(s.problem.bodies(), 0);
  std::vector<const std::vector<Option>*> order;
  for (const auto& branch : branches) order.push_back(&branch);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return cheaper(b->front().cost, a->front().cost); });
  for (const std::vector<Option>* branch : order) {
    const auto shares = [&](const Option& o) {
      const std::vector<FaceMove>& moves = s.problem.hypotheses[o.hypothesis].moves;
      return used[o.hypothesis] || std::any_of(moves.begin(), moves.end(), [&](const FaceMove& m) { return moved[m.body]; });
    };
    if (std::any_of(branch->begin(), branch->end(), shares)) continue;
    for (const Option& o : *branch) {
      used[o.hypothesis] = 1;
      for (const FaceMove& m : s.problem.hypotheses[o.hypothesis].moves) moved[m.body] = 1;
    }
    const Cost& least = branch->front().cost;
    bound = bound + Cost{least.fixed - cost_of(now).fixed, least.volume - cost_of(now).volume};
  }
  return bound;
}

void keep(Search& s, const Arrangement& now, const std::vector<int>& chosen, double residual) {
  const Cost cost = cost_of(now);
  if (s.found && !cheaper(cost, s.best.cost) && (cheaper(s.best.cost, cost) || residual >= s.best.residual)) return;
  s.found = true;
  s.best.chosen = chosen;
  s.best.cost = cost;
  s.best.residual = residual;
}

void visit(Search& s, const std::vector<int>& chosen, std::vector<char> closed) {
  ++s.best.nodes;
  s.context.check();
  if (std::chrono::steady_clock::now() > s.end) {
    s.best.optimal = false;
    return;
  }
  const Arrangement now = arrange(s.problem, chosen);
  if (penetrates(s.problem, now) || !s.admissible(now)) {
    ++s.best.pruned;
    return;
  }
  const Verdict verdict = judge(s, now);
  if (verdict.stands) return keep(s, now, chosen, verdict.residual);

  std::vector<std::vector<Option>> branches;
  for (const int c : verdict.certificates) {
    branches.push_back(options_of(s, cut_of(s, s.known[c], now, chosen), now, closed));
    if (!branches.back().empty()) continue;
    for (int i = 0; i < s.problem.bodies(); ++i) s.blame[i] += !s.known[c].collapse.motion[i].is_zero();
    ++s.best.pruned;
    return;
  }
  if (branches.empty()) {  // too close to call by any collapse: whatever is left may help
    std::vector<int> all(s.problem.hypotheses.size());
    for (std::size_t h = 0; h < all.size(); ++h) all[h] = static_cast<int>(h);
    branches.push_back(options_of(s, all, now, closed));
    if (branches.back().empty()) return;
  }
  if (s.found && !cheaper(lower_bound(s, now, branches), s.best.cost)) {
    ++s.best.pruned;
    return;
  }
  const auto fewest = std::min_element(branches.begin(), branches.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (const Option& option : *fewest) {
    if (s.found && !cheaper(option.cost, s.best.cost)) {
      ++s.best.pruned;
      break;
    }
    closed[option.hypothesis] = 1;
    // One hypothesis a pair: the others of this pair are closed below.
    std::vector<char> below = closed;
    const Hypothesis& h = s.problem.hypotheses[option.hypothesis];
    for (std::size_t k = 0; k < below.size(); ++k)
      if (s.problem.hypotheses[k].a == h.a && s.problem.hypotheses[k].b == h.b) below[k] = 1;
    visit(s, with(chosen, option.hypothesis), std::move(below));
  }
}

/// The body that dead ends speak against most; of equals the lowest.
int most_blamed(const Search& s) {
  int worst = -1;
  for (int i = s.problem.supports_count(); i < s.problem.bodies(); ++i) {
    if (s.held[i] || s.blame[i] == 0) continue;
    const auto height = [&](int body) { return s.problem.cuboid(body).initial.center.z(); };
    if (worst < 0 || s.blame[i] > s.blame[worst] || (s.blame[i] == s.blame[worst] && height(i) < height(worst))) worst = i;
  }
  return worst;
}

}  // namespace

bool cheaper(const Cost& a, const Cost& b) {
  return a.fixed != b.fixed ? a.fixed < b.fixed : a.volume < b.volume - kSameVolume;
}

Choice search_contacts(const Problem& problem, const Admissible& admissible, double time_limit, Context& context) {
  const auto limit = std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(time_limit));
  Search s{problem, admissible, context, std::chrono::steady_clock::now() + limit, arrange(problem, {}), largest_arrangement(problem),
           {}, std::vector<char>(problem.bodies(), 0), {}, {}, {}, false};
  s.best.cost = kNoCost;
  s.initial_touches = touching_pairs(problem, s.initial);
  for (;;) {
    s.known.clear();
    s.blame.assign(problem.bodies(), 0);
    visit(s, {}, std::vector<char>(problem.hypotheses.size(), 0));
    if (s.found || !s.best.optimal) break;
    const int body = most_blamed(s);
    if (body < 0) break;
    s.held[body] = 1;
  }
  if (!s.found) s.best.optimal = false;
  s.best.held = s.held;
  return s.best;
}

}  // namespace unseen::cuboids
