// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <map>

#include "cuboids/boxes/box_overlap.h"
#include "cuboids/evaluate/evaluate_parts.h"

namespace unseen::cuboids {
namespace {

using Edges = std::map<std::pair<int, int>, ContactKind>;

/// Two contacts between the same two make one edge, fixed if either is.
void add_edge(Edges& edges, int a, int b, ContactKind kind) {
  const auto [at, is_new] = edges.try_emplace(std::minmax(a, b), kind);
  if (!is_new && kind == ContactKind::fixed) at->second = kind;
}

/// m, between a box and the plane of a support.
double gap_to(const Support& support, const OrientedBox& box) {
  return support.plane.signed_distance(box.center) - half_extent(box, support.plane.normal);
}

}  // namespace

std::vector<Contact> initial_contacts(const Completion& result, double tolerance) {
  std::vector<Contact> contacts;
  const auto add = [&](int a, int b) {
    Contact contact;
    contact.a = a;
    contact.b = b;
    contacts.push_back(contact);
  };
  const auto& cuboids = result.cuboids;
  for (std::size_t i = 0; i < cuboids.size(); ++i) {
    for (const Support& support : result.supports)
      if (gap_to(support, cuboids[i].initial) <= tolerance) add(support.id, cuboids[i].id);
    for (std::size_t j = i + 1; j < cuboids.size(); ++j)
      if (separation(cuboids[i].initial, cuboids[j].initial) <= tolerance) add(cuboids[i].id, cuboids[j].id);
  }
  return contacts;
}

GraphScore score_contacts(const std::vector<Contact>& contacts, const Completion& result, const Truth& truth,
                          const Matching& matching) {
  // What stands for nothing true keeps a number of its own, below all ids.
  std::map<int, int> true_id;
  const std::vector<int> supports = match_supports(result, truth);
  int own = -2;
  for (std::size_t i = 0; i < result.supports.size(); ++i)
    true_id[result.supports[i].id] = supports[i] >= 0 ? truth.supports[supports[i]].id : own--;
  for (std::size_t i = 0; i < result.cuboids.size(); ++i) {
    const int t = matching.true_of_result[i];
    true_id[result.cuboids[i].id] = t >= 0 ? truth.cuboids[t].id : own--;
  }
  Edges found, real;
  for (const Contact& contact : contacts) {
    const int a = true_id.at(contact.a), b = true_id.at(contact.b);
    if (a != b) add_edge(found, a, b, contact.kind);  // pieces of one box are no edge
  }
  for (const Contact& contact : truth.contacts) add_edge(real, contact.a, contact.b, contact.kind);
  GraphScore score;
  score.edges = found.size();
  score.true_edges = real.size();
  for (const auto& [pair, kind] : found) {
    const auto at = real.find(pair);
    score.correct += at != real.end() && at->second == kind;
  }
  const auto share = [&](std::size_t of) {
    return of > 0 ? static_cast<double>(score.correct) / static_cast<double>(of) : 0.0;
  };
  score.precision = share(score.edges);
  score.recall = share(score.true_edges);
  const double sum = score.precision + score.recall;
  score.f1 = sum > 0 ? 2.0 * score.precision * score.recall / sum : 0.0;
  return score;
}

}  // namespace unseen::cuboids
