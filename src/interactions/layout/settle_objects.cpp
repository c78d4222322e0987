// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/settle_objects.h"

#include <algorithm>
#include <cmath>

#include "interactions/database/footprint.h"

namespace unseen::interactions {
namespace {

constexpr double kShiftSd = 0.2;                          // m
constexpr double kInsideSd = 0.1, kOverlapSd = 0.1;       // m of depth in a frame, m² of overlap
constexpr double kStep = 0.05, kFarthest = 0.5;           // m

/// How deep a point is in the box, 0 outside. m
double depth_in(const OrientedBox& box, const Vec3& point) {
  return std::max(0.0, -((box.axes.transpose() * (point - box.center)).cwiseAbs() - box.half_size).maxCoeff());
}

double overlap(const Object& a, const Object& b) {
  double shared = 0;
  for (const Polygon& p : footprint(a))
    for (const Polygon& q : footprint(b)) shared += area(intersection(p, q));
  return shared;
}

double covered(const Object& object) {
  double sum = 0;
  for (const Polygon& p : footprint(object)) sum += area(p);
  return sum;
}

Object moved(const Object& object, const Vec2& shift) { return Placement{{shift.x(), shift.y(), 0}, 0} * object; }

}  // namespace

double standing_cost(const Object& object, const Vec2& shift, std::span<const FoundObject> others, std::span<const Passing> people) {
  const Object there = moved(object, shift);
  double cost = shift.squaredNorm() / (kShiftSd * kShiftSd);
  for (const FoundObject& other : others)
    if (other.object.id != object.id) cost += std::pow(overlap(there, other.object) / kOverlapSd, 2);
  const std::size_t joints = object.superclass() == Superclass::table ? 1 : 3;
  for (const Passing& passing : people) {
    if (std::find(passing.uses.begin(), passing.uses.end(), object.id) != passing.uses.end()) continue;
    double deepest = 0;
    for (const Part& part : there.parts)
      for (std::size_t k = 0; k < joints; ++k) deepest = std::max(deepest, depth_in(part.box, passing.joints[k]));
    cost += std::pow(deepest / kInsideSd, 2);
  }
  return cost;
}

void settle_objects(std::vector<FoundObject>& objects, std::span<const Passing> people) {
  for (int round = 0; round < 2; ++round)
    for (FoundObject& found : objects) {
      Vec2 best = Vec2::Zero();
      double least = standing_cost(found.object, best, objects, people);
      for (double x = -kFarthest; x < kFarthest + kStep / 2 && least > 0; x += kStep)
        for (double y = -kFarthest; y < kFarthest + kStep / 2; y += kStep) {
          if (Vec2(x, y).squaredNorm() / (kShiftSd * kShiftSd) >= least) continue;
          const double cost = standing_cost(found.object, {x, y}, objects, people);
          if (cost >= least) continue;
          least = cost;
          best = {x, y};
        }
      found.object = moved(found.object, best);
    }
  constexpr double kSame = 0.5;  // of the smaller footprint
  std::stable_sort(objects.begin(), objects.end(), [](const FoundObject& a, const FoundObject& b) { return a.confidence > b.confidence; });
  std::vector<FoundObject> kept;
  for (const FoundObject& found : objects) {
    const auto inside = [&](const FoundObject& other) {
      return overlap(found.object, other.object) > kSame * std::min(covered(found.object), covered(other.object));
    };
    if (std::none_of(kept.begin(), kept.end(), inside)) kept.push_back(found);
  }
  objects = std::move(kept);
}

}  // namespace unseen::interactions
