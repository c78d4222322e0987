// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/complete.h"

#include <algorithm>

#include "cuboids/search/doubts.h"
#include "cuboids/search/hypotheses.h"
#include "cuboids/search/trims.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/smear.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids {
namespace {

/// Writes the chosen arrangement into the result.
void describe(const Problem& problem, const std::vector<char>& held, const Arrangement& arrangement, Completion& result) {
  const std::vector<Touch> touches = touching_pairs(problem, arrangement);
  const Structure structure = structure_of(problem, arrangement, touches, held);
  const Balance b = balance(structure.bodies, structure.contacts);
  const auto id = [&](int body) { return problem.is_support(body) ? problem.supports[body].id : problem.cuboid(body).id; };
  for (std::size_t i = 0; i < result.cuboids.size(); ++i) result.cuboids[i].box = arrangement.boxes[i];
  for (const auto& [a, c] : arrangement.fixed) {
    Contact contact{id(a), id(c), ContactKind::fixed, Vec3::UnitZ(), {}, {}};
    for (const Touch& touch : touches)
      if (touch.a == a && touch.b == c) {
        contact.direction = touch.interface.normal;
        contact.points = touch.interface.points;
      }
    if (contact.points.empty()) {  // apart, as pieces of one object may be
      const Vec3& second = arrangement.boxes[c - problem.supports_count()].center;
      const Vec3 first = problem.is_support(a) ? problem.supports[a].plane.project(second) : arrangement.boxes[a - problem.supports_count()].center;
      if (first != second) contact.direction = (second - first).normalized();
      contact.points = {0.5 * (first + second)};
    }
    result.contacts.push_back(std::move(contact));
  }
  std::vector<int> contact_of_touch(touches.size(), -1);
  for (std::size_t t = 0; t < touches.size(); ++t) {
    const Touch& touch = touches[t];
    if (std::find(arrangement.fixed.begin(), arrangement.fixed.end(), std::array{touch.a, touch.b}) != arrangement.fixed.end()) continue;
    contact_of_touch[t] = static_cast<int>(result.contacts.size());
    result.contacts.push_back({id(touch.a), id(touch.b), ContactKind::touching, touch.interface.normal, touch.interface.points,
                               std::vector<Vec3>(touch.interface.points.size(), Vec3::Zero())});
  }
  std::vector<int> next(touches.size(), 0);
  for (std::size_t p = 0; p < structure.contacts.size(); ++p) {
    const int t = structure.touch_of_contact[p];
    if (contact_of_touch[t] >= 0) result.contacts[contact_of_touch[t]].forces[next[t]++] = b.forces[p];
  }
  const std::vector<char> is_held = held_up(problem, arrangement, held), hangs = hanging(problem, arrangement, held);
  for (int i = problem.supports_count(); i < problem.bodies(); ++i)
    if (is_held[i]) (hangs[i] ? result.unsupported : result.held_outside).push_back(id(i));
  result.fixed_contacts = static_cast<int>(arrangement.fixed.size());
  result.extended_volume = 0.0;
  for (const Cuboid& cuboid : result.cuboids)  // a face that was seen may have moved inwards, within noise
    result.extended_volume += std::max(0.0, cuboid.box.volume() - cuboid.initial.volume());
  result.stability.residual = b.residual;
  result.stability.stable = b.residual < problem.stable_residual && result.unsupported.size() + result.held_outside.size() < result.cuboids.size();
  if (result.stability.stable) {
    result.stability.margin = margin(structure.bodies, structure.contacts, problem.stable_residual);
    result.stability.friction_needed = friction_needed(structure.bodies, structure.contacts, problem.stable_residual);
  }
}

}  // namespace

bool stands(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held) {
  const Structure s = structure_of(problem, arrangement, touching_pairs(problem, arrangement), held);
  return balance(s.bodies, s.contacts).residual < problem.stable_residual;
}

bool bears_pushes(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held) {
  const Structure s = structure_of(problem, arrangement, touching_pairs(problem, arrangement), held);
  const std::vector<Vec3> loads = load_cases(problem.push);
  return std::all_of(loads.begin(), loads.end(), [&](const Vec3& load) { return balance(s.bodies, s.contacts, load, {}).residual < problem.stable_residual; });
}

void complete_boxes(const RgbdFrame& frame, const Options& options, Context& context, Completion& result) {
  Summary& summary = result.summary;
  result.depth_noise = depth_noise(frame, options);
  const DepthView view(frame, result.T_world_camera, result.depth_noise);
  Problem problem;
  Rooms rooms;
  problem.friction = options.friction;
  problem.stable_residual = options.stable_residual;
  problem.push = options.push;
  {
    const Stage stage(context, summary, "hypotheses");
    std::vector<double> tolerance = contact_tolerance(view, result.cuboids);
    summary.counts.emplace_back("fused", fuse_pieces(view, result.cuboids, tolerance));
    summary.counts.emplace_back("by_symmetry", add_hidden_legs(view, result.cuboids, tolerance));
    int id = static_cast<int>(result.supports.size());
    for (Cuboid& cuboid : result.cuboids) {
      cuboid.id = id++;
      cuboid.box = cuboid.initial;
    }
    problem.supports = result.supports;
    problem.cuboids = result.cuboids;
    problem.tolerance = tolerance;
    problem.cut_off = cut_off(view, result.cuboids);
    problem.joints = joints_of(problem);
    part_overlaps(view, problem);
    rooms = find_rooms(view, problem.cuboids, tolerance);
    assume_thickness(view, rooms, problem);
    close_hidden_gaps(rooms, problem);
    problem.hypotheses = propose_contacts(problem, rooms);
    summary.counts.emplace_back("hypotheses", problem.hypotheses.size());
  }
  const Admissible admissible = [&](const Arrangement& a) {
    for (std::size_t i = 0; i < a.boxes.size(); ++i)
      if (a.boxes[i].volume() > problem.cuboids[i].initial.volume() &&
          !in_hidden_space(view, {&problem.cuboids[i].initial, 1}, a.boxes[i], problem.tolerance[i]))
        return false;
    return true;
  };
  Choice choice;
  {
    const Stage stage(context, summary, "search");
    choice = search_contacts(problem, admissible, {options.arrangements, options.time_limit}, context);
    result.search = {choice.nodes, choice.pruned, choice.optimal};
  }
  const Stage stage(context, summary, "refinement");
  Arrangement arrangement = arrange(problem, choice.chosen);
  for (const FaceMove& move : legs_to_their_plates(problem, rooms, arrangement)) {
    Arrangement longer = with_face(problem, arrangement, move.body - problem.supports_count(), move.face, move.length);
    if (!penetrates(problem, longer) && admissible(longer) && stands(problem, longer, choice.held)) arrangement = std::move(longer);
  }
  Arrangement closed = arrangement;
  close_contacts(problem, touching_pairs(problem, arrangement), closed);
  if (stands(problem, closed, choice.held) || !stands(problem, arrangement, choice.held)) arrangement = std::move(closed);
  link_hanging(problem, view, choice.held, arrangement, context);
  lower_residual(problem, rooms, admissible, choice.held, arrangement, context);
  end_overlaps(view, problem, choice.held, arrangement);
  settle(problem, choice.held, arrangement, context);
  const std::vector<char> falls = hold_together(problem, choice.held, arrangement, context);
  Ending ending{problem, choice.held, falls, std::move(arrangement), result.cuboids};
  drop_contained(view, ending);
  result.cuboids = ending.cuboids;
  for (std::size_t i = 0; i < result.cuboids.size(); ++i) result.cuboids[i].id = ending.problem.cuboids[i].id = static_cast<int>(result.supports.size() + i);
  if (std::optional<std::vector<char>> falls = trim_overlaps(view, ending.problem, ending.held, ending.arrangement, context)) ending.falls = std::move(*falls);
  describe(ending.problem, ending.held, ending.arrangement, result);
  warn_of_falls(ending.falls, problem.push, result, context);
  warn_of_no_boxes(view, ending.problem.tolerance, result.cuboids, context);
  warn_of_unmeasured(view, result.cuboids, context);
  summary.counts.emplace_back("cuboids", result.cuboids.size());
  summary.counts.emplace_back("contacts", result.contacts.size());
  if (result.cuboids.empty()) {
    summary.status = Status::infeasible;
    context.warn("no object found on the supports");
  } else if (!choice.optimal) {
    summary.status = Status::time_limit;
    context.warn("the search ended early: the best arrangement found by then is kept (--arrangements, --time-limit)");
  }
}

Completion complete_cuboids(const RgbdFrame& frame, const Completion& scene, const Options& options, Context& context) {
  check_options(options);
  Completion start;
  start.T_world_camera = scene.T_world_camera;
  start.supports = scene.supports;
  start.cuboids = scene.cuboids;
  return run_cuboids(context, std::move(start), [&](Completion& result) {
    const std::optional<RgbdFrame> sharp = without_smear(frame, context);
    const RgbdFrame& seen = sharp ? *sharp : frame;
    const Options exact = with_depth_noise(seen, options, context);
    realign(seen, exact, result, context);
    complete_boxes(seen, exact, context, result);
  });
}

}  // namespace unseen::cuboids
