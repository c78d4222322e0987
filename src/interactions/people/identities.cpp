// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/identities.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "interactions/people/identity_network.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr int kMostRounds = 40;    ///< in which paths part to find a first answer
constexpr double kMostWork = 3e6;  ///< links looked at while labels are brought together; then the best answer so far is taken

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
    const Paths paths = cheapest_paths(model, allowed);
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
  const Paths paths = cheapest_paths(model, allowed);
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

/// One person is expected, and nobody is seen beside him, nor marked.
bool is_alone(const Take& take) {
  if (take.people != 1 || !take.labels.empty()) return false;
  std::set<int> frames;
  return std::all_of(take.detections.begin(), take.detections.end(), [&](const Detection& d) { return d.person <= 0 && frames.insert(d.frame).second; });
}

}  // namespace

std::vector<int> identify(const Take& take) {
  if (take.detections.empty()) return {};
  if (is_alone(take)) return std::vector<int>(take.detections.size(), 0);
  const Sightings sightings = sightings_of(take);
  Search result;
  search(model_of(take, sightings), allowed_by_labels(take, sightings), result);
  if (result.best.empty()) throw InputError(take.name, "labels", "too many that contradict what is seen", "people who are where they are marked");
  return result.best;
}

}  // namespace unseen::interactions
