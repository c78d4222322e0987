// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/search_branch.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {

static constexpr double kClearly = 0.95;  // of the residual of what stands: it need not be brought any lower
static constexpr int kRounds = 20;

/// A fixed contact that leads out counts half: so the costs of parts are lower bounds of their shares in the whole.
static double cost_of_fixing(const Search& s, int a, int b) {
  const auto outside = [&](int body) { return !s.problem.is_support(body) && !s.inside[body]; };
  return outside(a) || outside(b) ? 0.5 : 1.0;
}

static bool is_grounded(const Search& s, int a) {
  return s.problem.is_support(a) && (s.problem.supports[a].kind == SupportKind::ground || s.problem.supports[a].kind == SupportKind::desk);
}

Cost cost_of(const Search& s, const Arrangement& now) {
  Cost cost;
  for (const auto& [a, b] : now.fixed) {
    cost.fixed += cost_of_fixing(s, a, b);
    cost.grounded += is_grounded(s, a);
  }
  for (std::size_t i = 0; i < now.boxes.size(); ++i)
    if (s.inside[s.problem.supports_count() + i]) cost.volume += now.boxes[i].volume() - s.problem.cuboids[i].initial.volume();
  return cost;
}

static double added_volume(const Search& s, const Arrangement& now, const Hypothesis& hypothesis) {
  Hypothesis within = hypothesis;
  std::erase_if(within.moves, [&](const FaceMove& move) { return !s.inside[move.body]; });
  return added_volume(s.problem, now, within);
}

static Cost operator+(const Cost& a, const Cost& b) { return {a.fixed + b.fixed, a.volume + b.volume, a.grounded + b.grounded}; }

std::vector<int> with(std::vector<int> chosen, int h) {
  chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), h), h);
  return chosen;
}

static Certificate certificate_of(const Search& s, Collapse collapse) {
  Certificate c{std::move(collapse), false, {}};
  c.of_initial = proven_residual(c.collapse, s.problem, s.initial, s.initial_touches, s.held) >= s.problem.stable_residual;
  if (c.of_initial) c.cut = remedies(c.collapse, s.problem, s.initial, s.largest, s.held, s.outside);
  return c;
}

static std::vector<int> most_moving(const Search& s, const Structure& structure, const Balance& b) {
  double fastest = 0.0;
  for (const Vec6& motion : b.motion) fastest = std::max(fastest, motion.norm());
  std::vector<int> out;
  for (int i = s.problem.supports_count(); i < s.problem.bodies(); ++i)
    if (!structure.bodies[structure.group[i]].is_static && b.motion[structure.group[i]].norm() > 0.5 * fastest) out.push_back(i);
  return out;
}

Verdict judge(Search& s, const Arrangement& now, const Effort& effort) {
  const std::vector<Touch> touches = touching_pairs(s.problem, now);
  Verdict verdict;
  for (std::size_t c = 0; c < s.known.size(); ++c)
    if (proven_residual(s.known[c].collapse, s.problem, now, touches, s.held) >= s.problem.stable_residual)
      verdict.certificates.push_back(static_cast<int>(c));
  if (!verdict.certificates.empty()) return verdict;
  const Structure structure = structure_of(s.problem, now, touches, s.held);
  std::vector<Vec3> forces;
  for (const Vec3& gravity : load_cases(s.problem.push)) {
    Balance b = balance(structure.bodies, structure.contacts, gravity, forces, effort, s.context);
    if (forces.empty()) verdict.residual = b.residual;
    verdict.stands = b.residual < s.problem.stable_residual;
    if (!verdict.stands) {
      verdict.moving = most_moving(s, structure, b);
      verdict.motion = motion_left(b, gravity, structure, s.problem);
      for (Collapse& collapse : collapses_of(verdict.motion, s.problem, now, touches, s.held)) {
        verdict.certificates.push_back(static_cast<int>(s.known.size()));
        s.known.push_back(certificate_of(s, std::move(collapse)));
      }
      return verdict;
    }
    forces = std::move(b.forces);
  }
  return verdict;
}

static std::vector<Option> options_of(const Search& s, const std::vector<int>& cut, const Arrangement& now,
                                      const std::vector<char>& closed) {
  std::vector<Option> out;
  const Cost base = cost_of(s, now);
  for (const int h : cut) {
    if (closed[h]) continue;
    const Hypothesis& hypothesis = s.problem.hypotheses[h];
    Cost added = {0.0, added_volume(s, now, hypothesis), 0.0};
    if (hypothesis.kind == ContactKind::fixed) added.fixed = cost_of_fixing(s, hypothesis.a, hypothesis.b), added.grounded = is_grounded(s, hypothesis.a);
    out.push_back({h, base + added});
  }
  std::stable_sort(out.begin(), out.end(), [](const Option& a, const Option& b) { return cheaper(a.cost, b.cost); });
  return out;
}

std::vector<Option> options_of(const Search& s, const Certificate& c, const Arrangement& now, const std::vector<int>& chosen,
                               const std::vector<char>& closed) {
  const bool fresh = std::none_of(c.cut.begin(), c.cut.end(),
                                  [&](int h) { return std::binary_search(chosen.begin(), chosen.end(), h); });
  if (c.of_initial && fresh) return options_of(s, c.cut, now, closed);
  return options_of(s, remedies(c.collapse, s.problem, now, s.largest, s.held, closed), now, closed);
}

/// What an arrangement costs at least once all collapses are stopped: cuts that share no hypothesis and move no body in
/// common add up.
static Cost lower_bound(const Search& s, const Arrangement& now, const std::vector<std::vector<Option>>& branches) {
  const Cost base = cost_of(s, now);
  Cost bound = base;
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
    bound = bound + Cost{least.fixed - base.fixed, least.volume - base.volume, least.grounded - base.grounded};
  }
  return bound;
}

void keep(Search& s, const Arrangement& now, const std::vector<int>& chosen, double residual) {
  const Cost cost = cost_of(s, now);
  if (s.found && !cheaper(cost, s.best.cost) && (cheaper(s.best.cost, cost) || residual >= s.best.residual)) return;
  s.found = true;
  s.best.chosen = chosen;
  s.best.cost = cost;
  s.best.residual = residual;
}

void blame(Search& s, const Verdict& verdict) {
  for (const int c : verdict.certificates)
    for (int i = 0; i < s.problem.bodies(); ++i) s.blame[i] += !s.known[c].collapse.motion[i].is_zero();
  if (verdict.certificates.empty())
    for (const int i : verdict.moving) ++s.blame[i];
}

void visit(Search& s, const std::vector<int>& chosen, std::vector<char> closed) {
  ++s.best.nodes;
  s.context.check();
  if (s.visits++ >= s.most_visits || is_late(s)) {
    s.best.optimal = false;
    return;
  }
  const Arrangement now = arrange(s.problem, chosen);
  if (penetrates(s.problem, now) || !s.admissible(now)) {
    ++s.best.pruned;
    return;
  }
  Verdict verdict = judge(s, now, {kClearly * s.problem.stable_residual, 1e-8, kRounds});
  if (verdict.stands && s.found && cheaper(s.best.cost, cost_of(s, now))) return;
  if (verdict.stands) verdict = judge(s, now);  // what is kept is at rest in the least-squares sense
  if (verdict.stands) return keep(s, now, chosen, verdict.residual);

  std::vector<std::vector<Option>> branches;
  for (const int c : verdict.certificates) {
    branches.push_back(options_of(s, s.known[c], now, chosen, closed));
    if (!branches.back().empty()) continue;
    blame(s, verdict);
    ++s.best.pruned;
    return;
  }
  if (branches.empty()) {  // too close to call by any collapse: what can resist the motion that is left may help
    branches.push_back(options_of(s, remedies(verdict.motion, s.problem, now, s.largest, s.held, closed), now, closed));
    if (branches.back().empty()) return blame(s, verdict);
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
  if (!s.found) blame(s, verdict);
}

}  // namespace unseen::cuboids
