// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <chrono>
#include <vector>

#include "cuboids/search/collapse.h"
#include "cuboids/search/search.h"

namespace unseen::cuboids {

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
  std::vector<char> outside;  ///< a hypothesis: about no body inside
  std::vector<char> held;    ///< a body: firm, as it is outside or as nothing can hold it
  std::vector<Certificate> known;
  int visits = 0, most_visits = 0;  ///< arrangements looked at for this part
  std::vector<int> blame;  ///< a body: in how many dead ends it was on the move
  Choice best;
  bool found = false;
};

/// What is known against an arrangement.
struct Verdict {
  bool stands = false;
  double residual = 0;
  std::vector<int> certificates;  ///< indices into Search::known
  Collapse motion;                ///< what is out of balance, where nothing was known
  std::vector<int> moving;        ///< bodies that are out of balance most
};

inline bool is_late(const Search& s) { return std::chrono::steady_clock::now() > s.end; }
std::vector<int> with(std::vector<int> chosen, int hypothesis);
Cost cost_of(const Search& s, const Arrangement& now);

/// What is known against an arrangement, or new: certificates are added to what is known.
Verdict judge(Search& s, const Arrangement& now, const Effort& effort = {});
/// The open hypotheses that could stop a collapse of an arrangement, the cheapest first.
std::vector<Option> options_of(const Search& s, const Certificate& c, const Arrangement& now, const std::vector<int>& chosen,
                               const std::vector<char>& closed);
/// Keeps an arrangement that stands if none better is known.
void keep(Search& s, const Arrangement& now, const std::vector<int>& chosen, double residual);
void blame(Search& s, const Verdict& verdict);
/// Everything beyond the chosen hypotheses that are not closed: the branch and bound.
void visit(Search& s, const std::vector<int>& chosen, std::vector<char> closed);

}  // namespace unseen::cuboids
