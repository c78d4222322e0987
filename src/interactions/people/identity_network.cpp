// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/identity_network.h"

#include <algorithm>

#include "interactions/people/min_cost_flow.h"

namespace unseen::interactions {
namespace {

constexpr double kMust = 1e7;     ///< what it would cost to leave out a detection that has a label

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
  const Detection& detection(int i) const { return model_.take.detections[static_cast<std::size_t>(i)]; }
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
    const double leaving = leave_cost(detection(i));
    const double bonus = is_known(model_, allowed_, i) ? kMust : 0.0;
    flow.add(in(i), out(i), 1, presence_cost(detection(i)) - bonus);
    if (slot == 0) flow.add(0, in(i), 1, 0.0);
    if (slot > 0 && !is_expected(i, -1)) flow.add(away(slot - 1), in(i), 1, leaving);
    if (slot + 1 == slots) flow.add(out(i), sink_, 1, 0.0);
    for (const Link& link : model_.links[static_cast<std::size_t>(i)])
      if (can_link(i, link.to)) flow.add(out(i), in(link.to), 1, link.cost);
    if (is_expected(i, 1)) {
      for (int next = slot + memory + 1; next < slots && (who(i) & busy(allowed_, slot, next)) == 0; ++next)
        for (const int to : model_.sightings.at[static_cast<std::size_t>(next)]) add_long_link(flow, i, to);
    } else {
      if (slot + 1 < slots) flow.add(out(i), sink_, 1, leaving + kAbsent * (slots - 1 - slot));
      if (slot + memory < slots) flow.add(out(i), away(slot + memory), 1, leaving + kAbsent * memory);
      for (const int to : returning_)
        if (slot_of(to) > slot + memory) add_long_link(flow, i, to);
    }
  }
  void add_long_link(MinCostFlow& flow, int from, int to) const {
    const double missed = slot_of(to) - slot_of(from) - 1;
    if (can_link(from, to)) flow.add(out(from), in(to), 1, leave_cost(detection(from)) + leave_cost(detection(to)) + kAbsent * missed);
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

}  // namespace

Model model_of(const Take& take, const Sightings& s) {
  Model model = {take, s, std::vector<std::vector<Link>>(take.detections.size())};
  const int slots = static_cast<int>(s.frames.size());
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (int next = s.slot[i] + 1; next <= s.slot[i] + s.memory && next < slots; ++next)
      for (const int to : s.at[static_cast<std::size_t>(next)]) model.links[i].push_back({to, link_cost(take, s, static_cast<int>(i), to)});
  return model;
}

bool is_known(const Model& model, const Allowed& allowed, int i) {
  const People who = allowed.detection[static_cast<std::size_t>(i)];
  const int slot = model.sightings.slot[static_cast<std::size_t>(i)];
  return is_one(who) && (who & busy(allowed, slot - 1, slot + 1)) != 0;
}

Paths cheapest_paths(const Model& model, const Allowed& allowed) { return Network(model, allowed).cheapest(); }

}  // namespace unseen::interactions
