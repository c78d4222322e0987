// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "cuboids/collapse.h"

namespace unseen::cuboids {
namespace {

constexpr int kUsualPart = 8;         // bodies
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
  SearchLimits limits;
  std::chrono::steady_clock::time_point end;
  Arrangement initial, largest;
  std::vector<Touch> initial_touches;
  std::vector<char> inside;  ///< a body: part of what is solved now
  std::vector<char> held;    ///< a body: firm, as it is outside or as nothing can hold it
  std::vector<Certificate> known;
  int visits = 0, most_visits = 0;  ///< arrangements looked at for this part
  std::vector<int> blame;  ///< a body: in how many dead ends it was on the move
  Choice best;
  bool found = false;
};

/// Costs of what is inside: a lower bound of its share in the costs of the whole.
double cost_of_fixing(const Search& s, int a, int b) {
  const auto outside = [&](int body) { return !s.problem.is_support(body) && !s.inside[body]; };
  return outside(a) || outside(b) ? 0.5 : 1.0;
}
Cost cost_of(const Search& s, const Arrangement& now) {
  Cost cost;
  for (const auto& [a, b] : now.fixed) cost.fixed += cost_of_fixing(s, a, b);
  for (std::size_t i = 0; i < now.boxes.size(); ++i)
    if (s.inside[s.problem.supports_count() + i]) cost.volume += now.boxes[i].volume() - s.problem.cuboids[i].initial.volume();
  return cost;
}
double added_volume(const Search& s, const Arrangement& now, const Hypothesis& hypothesis) {
  Hypothesis within = hypothesis;
  std::erase_if(within.moves, [&](const FaceMove& move) { return !s.inside[move.body]; });
  return added_volume(s.problem, now, within);
}
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

/// Gravity alone, then with a push from each side.
std::vector<Vec3> load_cases(double push) {
  constexpr int kSides = 8;
  std::vector<Vec3> cases = {-Vec3::UnitZ()};
  for (int i = 0; i < kSides && push > 0.0; ++i) {
    const double angle = 2.0 * kPi * i / kSides;
    cases.emplace_back(push * std::cos(angle), push * std::sin(angle), -1.0);
  }
  return cases;
}

/// What is known against an arrangement.
struct Verdict {
  bool stands = false;
  double residual = 0;
  std::vector<int> certificates;  ///< indices into Search::known
  std::vector<int> moving;        ///< bodies that are out of balance most
};

std::vector<int> most_moving(const Search& s, const Structure& structure, const Balance& b) {
  double fastest = 0.0;
  for (const Vec6& motion : b.motion) fastest = std::max(fastest, motion.norm());
  std::vector<int> out;
  for (int i = s.problem.supports_count(); i < s.problem.bodies(); ++i)
    if (!structure.bodies[structure.group[i]].is_static && b.motion[structure.group[i]].norm() > 0.5 * fastest) out.push_back(i);
  return out;
}

Verdict judge(Search& s, const Arrangement& now) {
  const std::vector<Touch> touches = touching_pairs(s.problem, now);
  Verdict verdict;
  for (std::size_t c = 0; c < s.known.size(); ++c)
    if (proven_residual(s.known[c].collapse, s.problem, now, touches, s.held) >= s.problem.stable_residual)
      verdict.certificates.push_back(static_cast<int>(c));
  if (!verdict.certificates.empty()) return verdict;
  const Structure structure = structure_of(s.problem, now, touches, s.held);
  std::vector<Vec3> forces;
  for (const Vec3& gravity : load_cases(s.problem.push)) {
    Balance b = balance(structure.bodies, structure.contacts, gravity, forces);
    if (forces.empty()) verdict.residual = b.residual;
    verdict.stands = b.residual < s.problem.stable_residual;
    if (!verdict.stands) {
      verdict.moving = most_moving(s, structure, b);
      for (Collapse& collapse : collapses_of(b, gravity, structure, s.problem, now, touches, s.held)) {
        verdict.certificates.push_back(static_cast<int>(s.known.size()));
        s.known.push_back(certificate_of(s, std::move(collapse)));
      }
      return verdict;
    }
    forces = std::move(b.forces);
  }
  return verdict;
}

/// The open hypotheses of a cut, the cheapest first.
std::vector<Option> options_of(const Search& s, const std::vector<int>& cut, const Arrangement& now,
                               const std::vector<char>& closed) {
  std::vector<Option> out;
  const Cost base = cost_of(s, now);
  for (const int h : cut) {
    if (closed[h]) continue;
    const Hypothesis& hypothesis = s.problem.hypotheses[h];
    const Cost added = {hypothesis.kind == ContactKind::fixed ? cost_of_fixing(s, hypothesis.a, hypothesis.b) : 0.0,
                        added_volume(s, now, hypothesis)};
    out.push_back({h, base + added});
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
    bound = bound + Cost{least.fixed - base.fixed, least.volume - base.volume};
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
  if (s.visits++ >= s.most_visits || std::chrono::steady_clock::now() > s.end) {
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
    blame(s, verdict);
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
  if (!s.found) blame(s, verdict);
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
  for (const Option& option : options_of(s, cut_of(s, c, now, chosen), now, closed)) {
    const Arrangement next = arrange(s.problem, with(chosen, option.hypothesis));
    if (penetrates(s.problem, next) || !s.admissible(next)) continue;
    if (proven_residual(c.collapse, s.problem, next, touching_pairs(s.problem, next), s.held) < s.problem.stable_residual)
      return option.hypothesis;
  }
  return -1;
}

/// A first arrangement that stands, without looking back: every collapse gets its cheapest remedy; a body for which there
/// is none is held.
void descend(Search& s, std::vector<char> closed, std::vector<char>& unheld) {
  std::vector<int> chosen;
  for (;;) {
    s.context.check();
    const Arrangement now = arrange(s.problem, chosen);
    const Verdict verdict = judge(s, now);
    if (verdict.stands) return keep(s, now, chosen, verdict.residual);
    int remedy = -1;
    for (const int c : verdict.certificates)
      if (remedy < 0) remedy = best_remedy(s, s.known[c], now, chosen, closed);
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
    unheld[body] = s.held[body] = 1;
    s.known.clear();
    s.blame.assign(s.problem.bodies(), 0);
  }
}

/// The best choice for some bodies, the others being firm as they are. Bodies that nothing can hold join `unheld`.
std::vector<int> solve_part(Search& s, const std::vector<int>& part, std::vector<char>& unheld) {
  s.inside.assign(s.problem.bodies(), 0);
  for (const int body : part) s.inside[body] = 1;
  // Each costs the more the larger the part is.
  s.most_visits = std::max(1, s.limits.arrangements * kUsualPart / std::max(kUsualPart, static_cast<int>(part.size())));
  std::vector<char> closed(s.problem.hypotheses.size(), 0);
  for (std::size_t h = 0; h < closed.size(); ++h)
    closed[h] = !s.inside[s.problem.hypotheses[h].a] && !s.inside[s.problem.hypotheses[h].b];
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
  return a.fixed != b.fixed ? a.fixed < b.fixed : a.volume < b.volume - kSameVolume;
}

Choice search_contacts(const Problem& problem, const Admissible& admissible, const SearchLimits& limits, Context& context) {
  const auto time = std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(limits.seconds));
  Search s{problem, admissible, context, limits, std::chrono::steady_clock::now() + time, arrange(problem, {}), largest_arrangement(problem),
           {}, {}, std::vector<char>(problem.bodies(), 0), {}, 0, 0, {}, {}, false};
  s.initial_touches = touching_pairs(problem, s.initial);
  Parts parts;
  for (int i = 0; i < problem.bodies(); ++i) parts.of.push_back(i);
  for (const Touch& touch : s.initial_touches)
    if (!problem.is_support(touch.a)) parts.join(touch.a, touch.b);

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
