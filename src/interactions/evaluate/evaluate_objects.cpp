// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include "interactions/evaluate/assignment.h"
#include "interactions/evaluate/evaluate_parts.h"

namespace unseen::interactions {
namespace {

constexpr double kCluster = 0.6, kGate = 1.5;  // m on the ground

/// One piece of furniture, on the ground.
struct FurniturePiece {
  int id = -1;
  std::string category;
  std::vector<Vec2> centers;  ///< of the objects that were put together in it

  Vec2 center() const { return std::accumulate(centers.begin(), centers.end(), Vec2(0, 0)) / static_cast<double>(centers.size()); }
};

std::vector<FurniturePiece> true_pieces(const Recording& truth, bool interacted) {
  std::vector<FurniturePiece> pieces;
  for (const Object& o : truth.objects) {
    const auto& ids = truth.interacted;
    const bool all_count = ids.empty() && !truth.uses_known;
    if ((all_count || std::find(ids.begin(), ids.end(), o.id) != ids.end()) != interacted) continue;
    pieces.push_back({o.id, o.category, {o.center().head<2>()}});
  }
  return pieces;
}

/// In the result's order, each object joins the nearest piece of its category whose centre is less than `kCluster` away: a method may say
/// one couch several times over, a seat here and a seat there.
std::vector<FurniturePiece> found_pieces(const std::vector<FoundObject>& found) {
  std::vector<FurniturePiece> pieces;
  for (const FoundObject& f : found) {
    const Vec2 center = f.object.center().head<2>();
    FurniturePiece* nearest = nullptr;
    double least = kCluster;
    for (FurniturePiece& piece : pieces) {
      const double d = (piece.center() - center).norm();
      if (piece.category == f.object.category && d < least) least = d, nearest = &piece;
    }
    if (nearest) nearest->centers.push_back(center);
    else pieces.push_back({f.object.id, f.object.category, {center}});
  }
  return pieces;
}

/// Assigns true pieces to found ones, says so in `scores`, and takes the found ones away.
void match(const std::vector<FurniturePiece>& truth, bool interacted, std::vector<FurniturePiece>& found, std::vector<ObjectScore>& scores) {
  Eigen::MatrixXd distance(truth.size(), found.size());
  for (std::size_t t = 0; t < truth.size(); ++t)
    for (std::size_t f = 0; f < found.size(); ++f)
      distance(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(f)) =
          superclass_of(truth[t].category) == superclass_of(found[f].category) ? (truth[t].center() - found[f].center()).norm() : INFINITY;
  const std::vector<int> column = assign(distance, kGate);
  std::vector<bool> taken(found.size(), false);
  for (std::size_t t = 0; t < truth.size(); ++t) {
    ObjectScore s = {truth[t].id, -1, truth[t].category, superclass_of(truth[t].category), interacted, {}};
    if (column[t] >= 0) {
      const auto f = static_cast<std::size_t>(column[t]);
      s.found = found[f].id;
      s.distance = distance(static_cast<Eigen::Index>(t), column[t]);
      taken[f] = true;
    }
    scores.push_back(s);
  }
  std::vector<FurniturePiece> rest;
  for (std::size_t f = 0; f < found.size(); ++f)
    if (!taken[f]) rest.push_back(found[f]);
  found = std::move(rest);
}

void summarize_distances(Evaluation& e) {
  std::vector<double> d;
  for (const ObjectScore& s : e.objects)
    if (s.interacted && s.distance) d.push_back(*s.distance);
  if (d.empty()) return;
  std::sort(d.begin(), d.end());
  const auto n = static_cast<double>(d.size());
  const double mean = std::accumulate(d.begin(), d.end(), 0.0) / n;
  e.mean_distance = mean;
  e.median_distance = 0.5 * (d[(d.size() - 1) / 2] + d[d.size() / 2]);
  if (d.size() < 2) return;
  double squares = 0;
  for (const double x : d) squares += (x - mean) * (x - mean);
  e.sd_distance = std::sqrt(squares / (n - 1.0));
}

}  // namespace

void score_objects(const std::vector<FoundObject>& objects, const Recording& truth, Evaluation& e) {
  std::vector<FurniturePiece> found = found_pieces(objects);
  const std::vector<FurniturePiece> used = true_pieces(truth, true);
  match(used, true, found, e.objects);
  match(true_pieces(truth, false), false, found, e.objects);
  for (const FurniturePiece& f : found) e.objects.push_back({-1, f.id, f.category, superclass_of(f.category), false, {}});
  e.interacted = static_cast<int>(used.size());
  e.false_objects = static_cast<int>(found.size());
  e.found = static_cast<int>(std::count_if(e.objects.begin(), e.objects.end(), [](const ObjectScore& s) { return s.interacted && s.found >= 0; }));
  summarize_distances(e);
}

}  // namespace unseen::interactions
