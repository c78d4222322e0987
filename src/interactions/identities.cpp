// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/identities.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "interactions/identity_labels.h"
#include "interactions/min_cost_flow.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr double kMust = 1e7;     ///< what it would cost to leave out a detection that has a label
constexpr int kMostRounds = 40;    ///< in which paths part to find a first answer
constexpr double kMostWork = 3e6;  ///< links looked at while labels are brought together; then the best answer so far is taken

/// What everybody does: the detections of each path, by frame.
using Paths = std::vector<std::vector<int>>;

struct Link {
  int to;
  double cost;
};

struct Model {
  const Take& take;
  const Sightings& sightings;
  std::vector<std::vector<Link>> links;  ///< of each detection to those within memory
};

Model model_of(const Take& take, const Sightings& s) {
  Model model = {take, s, std::vector<std::vector<Link>>(take.detections.size())};
  const int slots = static_cast<int>(s.frames.size());
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (int next = s.slot[i] + 1; next <= s.slot[i] + s.memory && next < slots; ++next)
      for (const int to : s.at[static_cast<std::size_t>(next)]) model.links[i].push_back({to, link_cost(take, s, static_cast<int>(i), to)});
  return model;
}

/// Whether a label (or a choice of the search) says who is at a detection.
bool is_known(const Model& model, const Allowed& allowed, int i) {
  const People who = allowed.detection[static_cast<std::size_t>(i)];
  const int slot = model.sightings.slot[static_cast<std::size_t>(i)];
  return is_one(who) && (who & busy(allowed, slot - 1, slot + 1)) != 0;
}

/// The network: for each slot a node "away", then two for each detection (in and out); the first node is the source, the last one the sink.
/// Who is known at a detection and has a label elsewhere may be away only by arcs that do not pass that label.
class Network {
 public:
  Network(const Model& model, const Allowed& allowed) : model_(model), allowed_(allowed), in_(model.take.detections.size()) {
    std::size_t node = 1;
    for (const std::vector<int>& detections : model.sightings.at) {
      away_.push_back(node++);
      for (const int i : detections) {
        in_[static_cast<std::size_t>(i)] = node;
        node += 2;
        if (is_expected(i, -1)) returning_.push_back(i);
      }
    }
    sink_ = node;
  }

  Paths cheapest() const {
    MinCostFlow flow(sink_ + 1);
    const int slots = static_cast<int>(away_.size());
    flow.add(0, away_.front(), model_.take.people, kAbsent);
    for (int slot = 0; slot < slots; ++slot) {
      const bool last = slot + 1 == slots;
      flow.add(away(slot), last ? sink_ : away(slot + 1), model_.take.people, last ? 0.0 : kAbsent);
      for (const int i : model_.sightings.at[static_cast<std::size_t>(slot)])
        if (who(i) != 0) add_detection(flow, i, slot);
    }
    return detections_of(flow.paths(model_.take.people));
  }

 private:
  std::size_t in(int i) const { return in_[static_cast<std::size_t>(i)]; }
  std::size_t out(int i) const { return in(i) + 1; }
  std::size_t away(int slot) const { return away_[static_cast<std::size_t>(slot)]; }
  int slot_of(int i) const { return model_.sightings.slot[static_cast<std::size_t>(i)]; }
  People who(int i) const { return allowed_.detection[static_cast<std::size_t>(i)]; }
  bool can_link(int from, int to) const { return (who(from) & who(to) & ~busy(allowed_, slot_of(from), slot_of(to))) != 0; }
  /// Whether it is known who is at a detection, and that he has a label before (−1) or after (1) it.
  bool is_expected(int i, int direction) const {
    if (!is_one(who(i))) return false;
    return (who(i) & (direction < 0 ? busy(allowed_, -1, slot_of(i)) : busy(allowed_, slot_of(i), static_cast<int>(model_.sightings.frames.size())))) != 0;
  }

  void add_detection(MinCostFlow& flow, int i, int slot) const {
    const int slots = static_cast<int>(away_.size()), memory = model_.sightings.memory;
    const double bonus = is_known(model_, allowed_, i) ? kMust : 0.0;
    flow.add(in(i), out(i), 1, presence_cost(model_.take.detections[static_cast<std::size_t>(i)]) - bonus);
    if (slot == 0) flow.add(0, in(i), 1, 0.0);
    if (slot > 0 && !is_expected(i, -1)) flow.add(away(slot - 1), in(i), 1, kLeave);
    if (slot + 1 == slots) flow.add(out(i), sink_, 1, 0.0);
    for (const Link& link : model_.links[static_cast<std::size_t>(i)])
      if (can_link(i, link.to)) flow.add(out(i), in(link.to), 1, link.cost);
    if (is_expected(i, 1)) {
      for (int next = slot + memory + 1; next < slots && (who(i) & busy(allowed_, slot, next)) == 0; ++next)
        for (const int to : model_.sightings.at[static_cast<std::size_t>(next)]) add_long_link(flow, i, to);
    } else {
      if (slot + 1 < slots) flow.add(out(i), sink_, 1, kLeave + kAbsent * (slots - 1 - slot));
      if (slot + memory < slots) flow.add(out(i), away(slot + memory), 1, kLeave + kAbsent * memory);
      for (const int to : returning_)
        if (slot_of(to) > slot + memory) add_long_link(flow, i, to);
    }
  }
  void add_long_link(MinCostFlow& flow, int from, int to) const {
    if (can_link(from, to)) flow.add(out(from), in(to), 1, 2 * kLeave + kAbsent * (slot_of(to) - slot_of(from) - 1));
  }

  Paths detections_of(const std::vector<std::vector<std::size_t>>& paths) const {
    std::vector<int> of_node(sink_ + 1, -1);
    for (std::size_t i = 0; i < in_.size(); ++i) of_node[in_[i]] = static_cast<int>(i);
    Paths found;
    for (const std::vector<std::size_t>& path : paths) {
      found.emplace_back();
      for (const std::size_t node : path)
        if (of_node[node] >= 0) found.back().push_back(of_node[node]);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return !a.empty() && (b.empty() || a < b); });  // who comes first is 0
    return found;
  }

  const Model& model_;
  const Allowed& allowed_;
  std::vector<std::size_t> away_, in_;
  std::vector<int> returning_;  ///< detections that are not reached from "away"
  std::size_t sink_ = 0;
};

/// Who a path can be: allowed at all its detections, and not known to be at another while it is away.
People who_can_be(const Model& model, const Allowed& allowed, const std::vector<int>& path) {
  People people = (People{1} << model.take.people) - 1;
  int before = -1;
  for (const int i : path) {
    const int slot = model.sightings.slot[static_cast<std::size_t>(i)];
    people &= allowed.detection[static_cast<std::size_t>(i)] & ~busy(allowed, before, slot);
    before = slot;
  }
  return people & ~busy(allowed, before, static_cast<int>(allowed.fixed.size()));
}

/// Finds a person for path i, moving others to another one if need be.
bool assign(const std::vector<People>& possible, std::size_t i, People& tried, std::vector<int>& path_of) {
  for (std::size_t p = 0; p < path_of.size(); ++p) {
    const People bit = People{1} << p;
    if (!(possible[i] & bit) || (tried & bit)) continue;
    tried |= bit;
    if (path_of[p] >= 0 && !assign(possible, static_cast<std::size_t>(path_of[p]), tried, path_of)) continue;
    path_of[p] = static_cast<int>(i);
    return true;
  }
  return false;
}

/// The path of each person; empty if there are not enough people for the paths.
std::vector<int> match(const std::vector<People>& possible) {
  std::vector<int> path_of(possible.size(), -1);
  for (std::size_t i = 0; i < possible.size(); ++i) {
    People tried = 0;
    if (!assign(possible, i, tried, path_of)) return {};
  }
  return path_of;
}

/// A detection of which it is to be decided whether a person is there.
struct Question {
  int detection = -1, person = 0;
};

/// The slot-by-slot cost of letting a path go on as another one after its detection i: what both next steps then cost together.
double swap_cost(const Model& model, const std::vector<int>& path, std::size_t i, const std::vector<int>& other) {
  const std::vector<int>& slot = model.sightings.slot;
  const auto next = std::find_if(other.begin(), other.end(), [&](int d) { return slot[static_cast<std::size_t>(d)] > slot[static_cast<std::size_t>(path[i])]; });
  if (next == other.begin() || next == other.end()) return std::numeric_limits<double>::infinity();
  const int before = *(next - 1);
  if (slot[static_cast<std::size_t>(before)] >= slot[static_cast<std::size_t>(path[i + 1])]) return std::numeric_limits<double>::infinity();
  return link_cost(model.take, model.sightings, path[i], *next) + link_cost(model.take, model.sightings, before, path[i + 1]);
}

/// Where a path that would be two people most likely goes over to another: the end of a step there that is open.
Question question_of(const Model& model, const Allowed& allowed, const Paths& paths, const std::vector<int>& path) {
  const auto who = [&](std::size_t i) { return allowed.detection[static_cast<std::size_t>(path[i])]; };
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = path.size();
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (is_one(who(i)) && (i + 1 == path.size() || is_one(who(i + 1)))) continue;
    if (best == path.size()) best = i;
    if (i + 1 == path.size()) continue;
    for (const std::vector<int>& other : paths)
      if (const double cost = &other == &path ? least : swap_cost(model, path, i, other); cost < least) {
        least = cost;
        best = i;
      }
  }
  if (best == path.size()) return {};
  const bool later = is_one(who(best));  // the step's first end is known, so its second one is open
  const std::size_t open = later ? best + 1 : best;
  People expected = who(open);
  if (later) {
    for (std::size_t i = path.size() - 1; i > open; --i)
      if (is_one(who(i)) && (who(i) & who(open))) expected = who(i);
  } else {
    for (std::size_t i = 0; i < open; ++i)
      if (is_one(who(i)) && (who(i) & who(open))) expected = who(i);
  }
  return {path[open], std::countr_zero(expected)};
}

/// The question about a path that nobody can be; if there is none, about any path.
Question question_of(const Model& model, const Allowed& allowed, const Paths& paths, const std::vector<People>& possible) {
  for (const bool impossible : {true, false})
    for (std::size_t i = 0; i < paths.size(); ++i)
      if ((possible[i] == 0) == impossible)
        if (const Question q = question_of(model, allowed, paths, paths[i]); q.detection >= 0) return q;
  return {};
}

struct Search {
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> best;  ///< person of each detection
  double work = 0;
};

double total_cost(const Model& model, const Paths& paths) {
  double cost = 0;
  for (const std::vector<int>& path : paths) cost += path_cost(model.take, model.sightings, path);
  return cost;
}

/// Takes an answer if all paths can be somebody and it is the best one so far. False if labels contradict the paths.
bool accept(const Model& model, const Paths& paths, const std::vector<People>& possible, double cost, Search& s) {
  const std::vector<int> path_of = match(possible);
  if (path_of.empty()) return false;
  if (cost >= s.least) return true;
  s.least = cost;
  s.best.assign(model.take.detections.size(), -1);
  for (std::size_t p = 0; p < path_of.size(); ++p)
    for (const int d : paths[static_cast<std::size_t>(path_of[p])]) s.best[static_cast<std::size_t>(d)] = static_cast<int>(p);
  return true;
}

std::vector<People> who_can_be(const Model& model, const Allowed& allowed, const Paths& paths) {
  std::vector<People> possible;
  for (const std::vector<int>& path : paths) possible.push_back(who_can_be(model, allowed, path));
  return possible;
}

/// Has the person who a path begins as leave it at the step where going over to another path costs least. False if nobody is in conflict.
bool part(const Model& model, const Paths& paths, const std::vector<int>& path, Allowed& allowed) {
  People who = (People{1} << model.take.people) - 1;
  std::size_t begin = 0, end = 0;
  int before = -1;
  for (; end < path.size(); ++end) {
    const auto d = static_cast<std::size_t>(path[end]);
    const People next = who & allowed.detection[d] & ~busy(allowed, before, model.sightings.slot[d]);
    if (next == 0) break;
    if (is_known(model, allowed, path[end])) begin = end;
    who = next;
    before = model.sightings.slot[d];
  }
  if (end < begin + 1 || end == path.size()) return false;
  std::size_t last = begin;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < end; ++i)
    for (const std::vector<int>& other : paths)
      if (const double cost = &other == &path ? least : swap_cost(model, path, i, other); cost < least) {
        least = cost;
        last = i;
      }
  const People leaving = who & -who;
  for (std::size_t i = begin; i < end; ++i) {
    People& people = allowed.detection[static_cast<std::size_t>(path[i])];
    if (const People left = i <= last ? people & leaving : people & ~leaving; left != 0) people = left;
  }
  return true;
}

/// A good answer, if not the best one, to measure others by: paths part where labels want it until all agree.
void dive(const Model& model, Allowed allowed, Search& s) {
  for (int round = 0; round < kMostRounds; ++round) {
    const Paths paths = Network(model, allowed).cheapest();
    const std::vector<People> possible = who_can_be(model, allowed, paths);
    if (accept(model, paths, possible, total_cost(model, paths), s)) return;
    bool parted = false;
    for (std::size_t i = 0; i < paths.size() && !parted; ++i) parted = possible[i] == 0 && part(model, paths, paths[i], allowed);
    if (!parted) return;
  }
}

/// Depth first: who must not be there comes last, for fixing somebody leads to an answer sooner.
void search(const Model& model, const Allowed& allowed, Search& s) {
  std::size_t links = 0;
  for (const std::vector<Link>& from : model.links) links += from.size();
  s.work += static_cast<double>(links) + 1e4;
  if (s.work > (s.best.empty() ? 10 : 1) * kMostWork) return;
  const Paths paths = Network(model, allowed).cheapest();
  std::size_t known = 0, kept = 0;
  for (const std::vector<int>& slots : allowed.fixed) known += slots.size();
  for (const std::vector<int>& path : paths)
    for (const int i : path) kept += is_known(model, allowed, i);
  if (kept < known) return;
  const double cost = total_cost(model, paths);
  if (cost >= s.least) return;
  const std::vector<People> possible = who_can_be(model, allowed, paths);
  if (accept(model, paths, possible, cost, s)) return;
  if (s.best.empty()) dive(model, allowed, s);
  const Question question = question_of(model, allowed, paths, possible);
  if (question.detection < 0) return;
  search(model, with_fixed(allowed, model.sightings, question.detection, question.person), s);
  Allowed without = allowed;
  without.detection[static_cast<std::size_t>(question.detection)] &= ~(People{1} << question.person);
  search(model, without, s);
}

}  // namespace

std::vector<int> identify(const Take& take) {
  if (take.detections.empty()) return {};
  const Sightings sightings = sightings_of(take);
  Search result;
  search(model_of(take, sightings), allowed_by_labels(take, sightings), result);
  if (result.best.empty()) throw InputError(take.name, "labels", "too many that contradict what is seen", "people who are where they are marked");
  return result.best;
}

}  // namespace unseen::interactions
