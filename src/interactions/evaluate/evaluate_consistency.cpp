// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/database/footprint.h"
#include "interactions/evaluate/evaluate_parts.h"

namespace unseen::interactions {
namespace {

constexpr double kDeep = 0.05;     // m inside a box
constexpr double kOnFloor = 0.15;  // m, height of an ankle whose foot stands

/// How deep a point lies in a box; negative outside.
double depth_in(const OrientedBox& box, const Vec3& p) { return (box.half_size - (box.axes.transpose() * (p - box.center)).cwiseAbs()).minCoeff(); }

bool inside(const std::vector<const Object*>& objects, const Vec3& p) {
  for (const Object* object : objects)
    for (const Part& part : object->parts)
      if (depth_in(part.box, p) > kDeep) return true;
  return false;
}

template <class People, class Frames>
double share_inside(const std::vector<const Object*>& objects, const People& people, Frames frames_of) {
  int deep = 0, frames = 0;
  for (const auto& person : people)
    for (const auto& f : frames_of(person)) ++frames, deep += inside(objects, f.pose.col(pelvis));
  return frames > 0 ? static_cast<double>(deep) / frames : 0.0;
}

/// Mean ground speed of ankles that are on the floor in two consecutive frames.
double skating(const std::vector<Person>& people, double fps) {
  double path = 0;
  int steps = 0;
  for (const Person& person : people)
    for (std::size_t i = 1; i < person.frames.size(); ++i) {
      const PersonFrame &a = person.frames[i - 1], &b = person.frames[i];
      if (b.frame != a.frame + 1) continue;
      for (const Joint ankle : {right_ankle, left_ankle}) {
        if (a.pose(2, ankle) > kOnFloor || b.pose(2, ankle) > kOnFloor) continue;
        path += (b.pose.col(ankle) - a.pose.col(ankle)).head<2>().norm();
        ++steps;
      }
    }
  return steps > 0 ? path / steps * fps : 0.0;
}

double lowest(const OrientedBox& box) { return box.center.z() - box.axes.row(2).cwiseAbs() * box.half_size; }
double highest(const OrientedBox& box) { return box.center.z() + box.axes.row(2).cwiseAbs() * box.half_size; }

/// The largest area that a part of one shares with a part of the other at the same height: a chair under a table is in nobody's way.
double overlap(const Object& a, const Object& b) {
  double most = 0;
  for (const Part& p : a.parts)
    for (const Part& q : b.parts)
      if (std::min(highest(p.box), highest(q.box)) > std::max(lowest(p.box), lowest(q.box)))
        most = std::max(most, area(intersection(footprint(p.box), footprint(q.box))));
  return most;
}

}  // namespace

void score_consistency(const Reconstruction& result, const Recording& truth, Evaluation& e) {
  std::vector<const Object*> found, real;
  for (const FoundObject& f : result.objects) found.push_back(&f.object);
  for (const Object& o : truth.objects) real.push_back(&o);
  e.inside_objects = share_inside(found, result.people, [](const Person& p) -> const auto& { return p.frames; });
  e.true_inside_objects = share_inside(real, truth.people, [](const auto& p) -> const auto& { return p; });
  e.foot_skating = skating(result.people, result.fps > 0.0 ? result.fps : truth.fps);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = i + 1; j < found.size(); ++j) e.overlapping += overlap(*found[i], *found[j]);
}

}  // namespace unseen::interactions
