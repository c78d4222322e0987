// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cuboids/search/search_branch.h"

namespace unseen::cuboids {
namespace {

constexpr int kUsualPart = 8;         // bodies
constexpr double kSameVolume = 1e-9;  // m³
constexpr Cost kNoCost = {std::numeric_limits<int>::max(), std::numeric_limits<double>::infinity(), 0.0};

/// Every face moved as far as any hypothesis asks.
Arrangement largest_arrangement(const Problem& problem) {
  std::vector<int> all(problem.hypotheses.size());
  for (std::size_t h = 0; h < all.size(); ++h) all[h] = static_cast<int>(h);
  Arrangement a = arrange(problem, all);
  a.fixed = problem.joints;
  return a;
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

/// The cheapest open hypothesis that stops a collapse at once and gives an allowed arrangement; −1 if there is none.
int best_remedy(Search& s, const Certificate& c, const Arrangement& now, const std::vector<int>& chosen,
                const std::vector<char>& closed) {
  for (const Option& option : options_of(s, c, now, chosen, closed)) {
    const Arrangement next = arrange(s.problem, with(chosen, option.hypothesis));
    if (penetrates(s.problem, next) || !s.admissible(next)) continue;
    if (proven_residual(c.collapse, s.problem, next, touching_pairs(s.problem, next), s.held) < s.problem.stable_residual)
      return option.hypothesis;
  }
  return -1;
}

/// A first arrangement that stands, without looking back: every collapse gets its cheapest remedy; a body for which there
/// is none is held. When time is up all that moves is held.
void descend(Search& s, std::vector<char> closed, std::vector<char>& unheld) {
  std::vector<int> chosen;
  for (;;) {
    s.context.check();
    const Arrangement now = arrange(s.problem, chosen);
    const Verdict verdict = judge(s, now);
    if (verdict.stands) return keep(s, now, chosen, verdict.residual);
    int remedy = -1;
    const bool late = is_late(s);
    for (const int c : verdict.certificates)
      if (remedy < 0 && !late) remedy = best_remedy(s, s.known[c], now, chosen, closed);
    if (remedy >= 0) {
      chosen = with(chosen, remedy);
      const Hypothesis& h = s.problem.hypotheses[remedy];
      for (std::size_t k = 0; k < closed.size(); ++k)
        if (s.problem.hypotheses[k].a == h.a && s.problem.hypotheses[k].b == h.b) closed[k] = 1;
      continue;
    }
    blame(s, verdict);
    const int body = most_blamed(s);
    if (body < 0) return;
    for (int i = 0; i < s.problem.bodies(); ++i)
      if (i == body || (late && s.blame[i] > 0)) unheld[i] = s.held[i] = 1;
    if (late) s.best.optimal = false;
    s.known.clear();
    s.blame.assign(s.problem.bodies(), 0);
  }
}

/// The best choice for some bodies, the others being firm as they are. Bodies that nothing can hold join `unheld`.
std::vector<int> solve_part(Search& s, const std::vector<int>& part, std::vector<char>& unheld) {
  s.inside.assign(s.problem.bodies(), 0);
  for (const int body : part) s.inside[body] = 1;
  // Each costs the more the larger the part is.
  const double larger = std::max(1.0, static_cast<double>(part.size()) / kUsualPart);
  s.most_visits = std::max(1, static_cast<int>(s.limits.arrangements / (larger * larger)));
  std::vector<char> closed(s.problem.hypotheses.size(), 0);
  for (std::size_t h = 0; h < closed.size(); ++h)
    closed[h] = !s.inside[s.problem.hypotheses[h].a] && !s.inside[s.problem.hypotheses[h].b];
  s.outside = closed;
  const auto start = [&](const std::vector<char>& firm) {
    for (int i = s.problem.supports_count(); i < s.problem.bodies(); ++i) s.held[i] = !s.inside[i] || firm[i];
    s.known.clear();
    s.blame.assign(s.problem.bodies(), 0);
    s.found = false;
    s.visits = 0;
    s.best.cost = kNoCost;
    s.best.chosen.clear();
  };
  std::vector<char> greedy(s.problem.bodies(), 0);
  start(greedy);
  descend(s, closed, greedy);
  if (greedy == unheld) {  // nothing had to be held: what is found bounds the search
    visit(s, {}, closed);
    return s.best.chosen;
  }
  const std::vector<int> fallback = s.best.chosen;
  for (;;) {
    start(unheld);
    visit(s, {}, closed);
    if (s.found) return s.best.chosen;
    const int body = s.visits > s.most_visits ? -1 : most_blamed(s);
    if (body < 0) break;
    unheld[body] = 1;
  }
  unheld = greedy;
  return fallback;
}

/// Parts of the scene: bodies numbered alike are solved together.
struct Parts {
  std::vector<int> of;

  void join(int a, int b) {
    const int from = std::max(of[a], of[b]), to = std::min(of[a], of[b]);
    std::replace(of.begin(), of.end(), from, to);
  }
  std::vector<int> members(int part) const {
    std::vector<int> out;
    for (std::size_t i = 0; i < of.size(); ++i)
      if (of[i] == part) out.push_back(static_cast<int>(i));
    return out;
  }
};

/// Joins parts whose solutions reach into each other; true if there were any.
bool join_entangled(const Search& s, const std::vector<int>& chosen, Parts& parts) {
  bool joined = false;
  const auto join = [&](int a, int b) {
    if (s.problem.is_support(a) || s.problem.is_support(b) || parts.of[a] == parts.of[b]) return;
    parts.join(a, b);
    joined = true;
  };
  for (const int h : chosen) {
    join(s.problem.hypotheses[h].a, s.problem.hypotheses[h].b);
    for (const FaceMove& move : s.problem.hypotheses[h].moves) join(move.body, s.problem.hypotheses[h].b);
  }
  if (joined) return true;
  for (const Touch& touch : touching_pairs(s.problem, arrange(s.problem, chosen))) join(touch.a, touch.b);
  return joined;
}

}  // namespace

bool cheaper(const Cost& a, const Cost& b) {
  if (a.fixed != b.fixed) return a.fixed < b.fixed;
  return std::abs(a.volume - b.volume) > kSameVolume ? a.volume < b.volume : a.grounded < b.grounded;
}

Choice search_contacts(const Problem& problem, const Admissible& admissible, const SearchLimits& limits, Context& context) {
  const auto time = std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(limits.seconds));
  Search s{problem, admissible, context, limits, std::chrono::steady_clock::now() + time, arrange(problem, {}), largest_arrangement(problem),
           {}, {}, {}, std::vector<char>(problem.bodies(), 0), {}, 0, 0, {}, {}, false};
  s.initial_touches = touching_pairs(problem, s.initial);
  Parts parts;
  for (int i = 0; i < problem.bodies(); ++i) parts.of.push_back(i);
  for (const Touch& touch : s.initial_touches)
    if (!problem.is_support(touch.a)) parts.join(touch.a, touch.b);

  for (const auto& [a, b] : problem.joints) parts.join(a, b);

  std::map<std::vector<int>, std::pair<std::vector<int>, std::vector<char>>> solved;  // a part: hypotheses, unheld bodies
  Choice choice;
  do {
    choice.chosen.clear();
    choice.held.assign(problem.bodies(), 0);
    for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
      const std::vector<int> part = parts.members(i);
      if (part.empty()) continue;
      auto& [chosen, unheld] = solved[part];
      if (unheld.empty()) {
        unheld.assign(problem.bodies(), 0);
        chosen = solve_part(s, part, unheld);
      }
      choice.chosen.insert(choice.chosen.end(), chosen.begin(), chosen.end());
      for (std::size_t k = 0; k < unheld.size(); ++k) choice.held[k] |= unheld[k];
    }
    std::sort(choice.chosen.begin(), choice.chosen.end());
  } while (join_entangled(s, choice.chosen, parts));
  s.inside.assign(problem.bodies(), 1);
  choice.cost = cost_of(s, arrange(problem, choice.chosen));
  choice.residual = s.best.residual;
  choice.nodes = s.best.nodes;
  choice.pruned = s.best.pruned;
  choice.optimal = s.best.optimal;
  return choice;
}

}  // namespace unseen::cuboids
