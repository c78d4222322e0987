// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "unseen/core/error.h"
#include "unseen/planes/evaluate.h"

namespace unseen::planes {

std::vector<double> folded_angles(const std::vector<double>& generators) {
  std::vector<double> angles = {0.0};
  for (const double generator : generators) {
    if (!(generator > 0.0))
      throw InputError("evaluate", "angles", fmt::format("{} rad", generator), "angles above 0");
    for (int k = 1; k * generator < kPi - 1e-9; ++k)
      angles.push_back(std::min(k * generator, kPi - k * generator));
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < 1e-9; }),
               angles.end());
  return angles;
}

std::size_t count_near_misses(const std::vector<Plane>& planes, const std::vector<double>& generators,
                              double exact, double near) {
  const std::vector<double> angles = folded_angles(generators);
  std::size_t count = 0;
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      const double angle = line_angle(planes[a].normal, planes[b].normal);
      double off = kPi;
      for (const double theta : angles) off = std::min(off, std::abs(angle - theta));
      if (off > exact && off < near) ++count;
    }
  return count;
}

RelationScore evaluate_relations(const Arrangement& arrangement) {
  RelationScore score;
  score.planes = arrangement.planes.size();
  score.directions = arrangement.directions.size();
  score.frames = arrangement.frames.size();
  score.relations = arrangement.relations.size();
  score.plane_relations = arrangement.plane_relations;
  const auto worse = [&](double error) { score.largest_error = std::max(score.largest_error, error); };
  for (const Relation& relation : arrangement.relations) {
    const Vec3& a = arrangement.directions.at(relation.a).normal;
    const Vec3& b = arrangement.directions.at(relation.b).normal;
    worse(std::abs(line_angle(a, b) - relation.angle));
  }
  std::vector<Plane> planes;
  for (const ArrangedPlane& plane : arrangement.planes) {
    planes.push_back(plane.plane);
    if (plane.direction >= 0)
      worse(line_angle(plane.plane.normal, arrangement.directions.at(plane.direction).normal));
  }
  for (const std::vector<int>& group : arrangement.coplanar)
    for (const int id : group) worse(line_angle(planes.at(id).normal, planes.at(group.front()).normal));
  score.near_misses = count_near_misses(planes, arrangement.angles);
  return score;
}

}  // namespace unseen::planes
