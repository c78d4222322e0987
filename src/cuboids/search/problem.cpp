// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/problem.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace unseen::cuboids {
namespace {

constexpr double kGravity = 9.81;  // m/s²
constexpr double kFarPieces = 0.1;  // m: farther pieces of an object are apart by their centres

}  // namespace

Vec3 face_normal(const OrientedBox& box, int face) {
  const Vec3 axis = box.axes.col(face / 2);
  return face % 2 == 0 ? Vec3(-axis) : axis;
}

OrientedBox extended(const OrientedBox& box, const Extension& extension) {
  OrientedBox out = box;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = extension[2 * axis], high = extension[2 * axis + 1];
    out.half_size[axis] += 0.5 * (low + high);
    out.center += 0.5 * (high - low) * box.axes.col(axis);
  }
  return out;
}

OrientedBox extended(const OrientedBox& box, int face, double length) {
  Extension extension{};
  extension[face] = length;
  return extended(box, extension);
}

double Problem::pair_tolerance(int a, int b) const {
  const double second = tolerance[b - supports_count()];
  return is_support(a) ? second : std::max(tolerance[a - supports_count()], second);
}

std::vector<std::array<int, 2>> joints_of(const Problem& problem) {
  std::vector<std::array<int, 2>> joints;
  std::vector<char> is_joined(problem.bodies(), 0);
  const auto distance = [&](int a, int b) {
    const auto meet = interface_of(solid_of(problem.cuboid(a).initial), solid_of(problem.cuboid(b).initial), kFarPieces);
    return meet ? meet->gap : (problem.cuboid(a).initial.center - problem.cuboid(b).initial.center).norm();
  };
  for (int first = problem.supports_count(); first < problem.bodies(); ++first) {
    if (is_joined[first]) continue;
    std::vector<int> joined = {first}, apart;
    for (int b = first + 1; b < problem.bodies(); ++b)
      if (problem.is_one_object(first, b)) apart.push_back(b);
    while (!apart.empty()) {
      std::array<int, 2> nearest{};
      double least = std::numeric_limits<double>::infinity();
      for (const int a : joined)
        for (const int b : apart)
          if (const double d = distance(a, b); d < least) least = d, nearest = {a, b};
      joints.push_back({std::min(nearest[0], nearest[1]), std::max(nearest[0], nearest[1])});
      joined.push_back(nearest[1]);
      is_joined[nearest[1]] = 1;
      std::erase(apart, nearest[1]);
    }
  }
  return joints;
}

Arrangement arrange(const Problem& problem, const std::vector<int>& chosen) {
  Arrangement out;
  out.fixed = problem.joints;
  out.extension.assign(problem.cuboids.size(), Extension{});
  for (const int h : chosen) {
    const Hypothesis& hypothesis = problem.hypotheses[h];
    for (const FaceMove& move : hypothesis.moves) {
      double& length = out.extension[move.body - problem.supports_count()][move.face];
      length = std::max(length, move.length);
    }
    if (hypothesis.kind == ContactKind::fixed) out.fixed.push_back({hypothesis.a, hypothesis.b});
  }
  for (std::size_t i = 0; i < problem.cuboids.size(); ++i) {
    out.boxes.push_back(extended(problem.cuboids[i].initial, out.extension[i]));
    out.solids.push_back(solid_of(out.boxes.back()));
    out.extended_volume += out.boxes.back().volume() - problem.cuboids[i].initial.volume();
  }
  std::sort(out.fixed.begin(), out.fixed.end());
  out.fixed.erase(std::unique(out.fixed.begin(), out.fixed.end()), out.fixed.end());
  return out;
}

Arrangement with_face(const Problem& problem, Arrangement arrangement, int cuboid, int face, double move) {
  const OrientedBox& initial = problem.cuboids[cuboid].initial;
  double& length = arrangement.extension[cuboid][face];
  length = std::max(length + move, -kMostShrink * 2.0 * initial.half_size[face / 2]);
  const double before = arrangement.boxes[cuboid].volume();
  arrangement.boxes[cuboid] = extended(initial, arrangement.extension[cuboid]);
  arrangement.solids[cuboid] = solid_of(arrangement.boxes[cuboid]);
  arrangement.extended_volume += arrangement.boxes[cuboid].volume() - before;
  return arrangement;
}

double added_volume(const Problem& problem, const Arrangement& arrangement, const Hypothesis& hypothesis) {
  double added = 0.0;
  for (std::size_t m = 0; m < hypothesis.moves.size(); ++m) {
    const int body = hypothesis.moves[m].body;
    const auto is_body = [&](const FaceMove& move) { return move.body == body; };
    if (std::any_of(hypothesis.moves.begin(), hypothesis.moves.begin() + m, is_body)) continue;
    const int k = body - problem.supports_count();
    Extension extension = arrangement.extension[k];
    for (const FaceMove& move : hypothesis.moves)
      if (is_body(move)) extension[move.face] = std::max(extension[move.face], move.length);
    added += extended(problem.cuboids[k].initial, extension).volume() - arrangement.boxes[k].volume();
  }
  return added;
}

std::vector<Vec3> load_cases(double push) {
  constexpr int kSides = 8;
  std::vector<Vec3> cases = {-Vec3::UnitZ()};
  for (int i = 0; i < kSides && push > 0.0; ++i) {
    const double angle = 2.0 * kPi * i / kSides;
    cases.emplace_back(push * std::cos(angle), push * std::sin(angle), -1.0);
  }
  return cases;
}

Structure structure_of(const Problem& problem, const Arrangement& arrangement, const std::vector<Touch>& touches,
                       const std::vector<char>& held) {
  std::vector<Body> bodies(problem.bodies());
  std::vector<int> parent(problem.bodies());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (int i = 0; i < problem.bodies(); ++i) {
    bodies[i].is_static = problem.is_support(i) || held[i];
    if (problem.is_support(i)) continue;
    const OrientedBox& box = arrangement.boxes[i - problem.supports_count()];
    bodies[i].weight = problem.cuboid(i).density * box.volume() * kGravity;
    bodies[i].center = box.center;
    bodies[i].half_size = box.half_size.norm();
  }
  for (const auto& [a, b] : arrangement.fixed) {
    const int first = root(a), second = root(b);
    parent[std::max(first, second)] = std::min(first, second);
  }
  Structure out;
  out.group.assign(problem.bodies(), -1);
  int groups = 0;
  for (int i = 0; i < problem.bodies(); ++i) out.group[i] = root(i) == i ? groups++ : out.group[root(i)];
  out.bodies = merge(bodies, out.group, groups);
  for (std::size_t t = 0; t < touches.size(); ++t) {
    const int a = out.group[touches[t].a], b = out.group[touches[t].b];
    if (a == b || (out.bodies[a].is_static && out.bodies[b].is_static)) continue;
    const Vec3& normal = touches[t].interface.normal;
    for (const Vec3& point : touches[t].interface.points) {
      out.contacts.push_back({a, b, point, normal, measured_friction(normal, problem.friction)});
      out.touch_of_contact.push_back(static_cast<int>(t));
    }
  }
  return out;
}

}  // namespace unseen::cuboids
