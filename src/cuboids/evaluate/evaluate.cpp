// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/evaluate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cuboids/evaluate/evaluate_parts.h"
#include "cuboids/evaluate/referee.h"
#include "cuboids/synth/synth_builder.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr double kStill = 0.05;   // share of its size that a standing box may move
constexpr double kShell = 0.01;   // m around an initial box that is neither seen nor hidden: noise
constexpr int kCells = 40;        // a side, where volumes are sampled

void check(const Truth& truth) {
  if (truth.cuboids.empty()) throw InputError("truth", "cuboids", "none", "at least one");
  for (const TrueCuboid& cuboid : truth.cuboids)
    if (!(cuboid.size.minCoeff() > 0)) throw InputError("truth", "size", "0 or less", "three lengths above 0");
  for (const TrueCuboid& cuboid : truth.cuboids)
    if (cuboid.box.has_value() != truth.cuboids.front().box.has_value())
      throw InputError("truth", "cuboids", "some with a pose, some without", "all or none with a pose");
}

void check(const Completion& result, const EvaluateOptions& options) {
  if (!(options.tolerance >= 0)) throw InputError("evaluate", "tolerance", std::to_string(options.tolerance), "0 or more");
  if (!(options.seconds > 0)) throw InputError("evaluate", "seconds", std::to_string(options.seconds), "above 0");
  for (const Cuboid& cuboid : result.cuboids)
    if (!(cuboid.box.half_size.minCoeff() > 0))
      throw InputError("result", "size", "0 or less", "three lengths above 0");
}

/// The smallest turn between two boxes, axes being exchangeable and without sign.
double angle_between(const OrientedBox& a, const OrientedBox& b) {
  const Mat3 turn = a.axes.transpose() * b.axes;
  double most = -1.0;
  std::array<int, 3> order = {0, 1, 2};
  do {
    // A signed permutation P has det(P) = 1 if its signs multiply to the parity of the order.
    double trace = 0, least = 1.0, product = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double entry = turn(k, order[k]);
      trace += std::abs(entry);
      least = std::min(least, std::abs(entry));
      product *= entry < 0 ? -1.0 : 1.0;
    }
    const bool even = (order[1] - order[0] + 3) % 3 == 1;
    if ((product > 0) != even) trace -= 2.0 * least;
    most = std::max(most, trace);
  } while (std::next_permutation(order.begin(), order.end()));
  return std::acos(std::clamp((most - 1.0) / 2.0, -1.0, 1.0));
}

RefereeScore ask_referee(const Completion& result, const EvaluateOptions& options, Context& context) {
  RefereeScene scene;
  scene.supports = result.supports;
  scene.friction = options.friction;
  std::map<int, int> index;
  for (const Support& support : result.supports) index[support.id] = -1;
  for (const Cuboid& cuboid : result.cuboids) {
    index[cuboid.id] = static_cast<int>(scene.boxes.size());
    scene.boxes.push_back(cuboid.box);
    scene.masses.push_back(cuboid.mass());
  }
  for (const Contact& contact : result.contacts)
    if (contact.kind == ContactKind::fixed) scene.fixed.emplace_back(index.at(contact.a), index.at(contact.b));
  for (const auto* ids : {&result.unsupported, &result.held_outside})
    for (const int id : *ids) scene.fixed.emplace_back(-1, index.at(id));
  const std::vector<double> moved = simulate(scene, -Vec3::UnitZ(), options.seconds, context);
  const std::vector<int> body = bodies_of(scene);
  RefereeScore score;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (body[i] < 0) continue;
    ++score.bodies;
    if (moved[i] < kStill) ++score.still;
    else score.moved.push_back(result.cuboids[i].id);
    score.farthest = std::max(score.farthest, moved[i]);
  }
  score.share = score.bodies > 0 ? static_cast<double>(score.still) / static_cast<double>(score.bodies) : 0.0;
  return score;
}

}  // namespace

PoseScore score_pose(const Completion& result, const Truth& truth, const Matching& matching) {
  PoseScore score;
  const std::vector<OrientedBox> complete = joined(result, matching);
  for (std::size_t t = 0; t < truth.cuboids.size(); ++t) {
    if (matching.pieces[t].empty()) continue;
    const int r = matching.pieces[t].front();
    const OrientedBox& real = *truth.cuboids[t].box;
    ++score.boxes;
    score.iou_before += intersection_over_union(result.cuboids[r].initial, real);
    score.iou_after += intersection_over_union(complete[r], real);
    score.center += (complete[r].center - real.center).norm();
    score.angle += angle_between(complete[r], real);
  }
  for (double* mean : {&score.iou_before, &score.iou_after, &score.center, &score.angle})
    if (score.boxes > 0) *mean /= static_cast<double>(score.boxes);
  return score;
}

HiddenPartScore score_hidden_part(const Completion& result, const Truth& truth, const Matching& matching) {
  HiddenPartScore score;
  double both = 0, either = 0;
  const std::vector<OrientedBox> complete = joined(result, matching);
  for (std::size_t t = 0; t < truth.cuboids.size(); ++t) {
    if (matching.pieces[t].empty()) continue;
    const int r = matching.pieces[t].front();
    const OrientedBox& real = *truth.cuboids[t].box;
    std::vector<OrientedBox> seen;  // of all pieces
    for (const int piece : matching.pieces[t]) {
      seen.push_back(result.cuboids[piece].initial);
      seen.back().half_size.array() += kShell;
    }
    Eigen::AlignedBox3d reach;  // of both boxes, in the true one's axes
    for (const OrientedBox& box : {real, complete[r]})
      for (const Vec3& corner : corners_of(box)) reach.extend(real.axes.transpose() * corner);
    const Vec3 step = reach.sizes() / kCells;
    const double cell = step.prod();
    for (int i = 0; i < kCells * kCells * kCells; ++i) {
      const Vec3 at(i % kCells + 0.5, i / kCells % kCells + 0.5, i / (kCells * kCells) + 0.5);
      const Vec3 p = real.axes * (reach.min() + at.cwiseProduct(step));
      if (std::any_of(seen.begin(), seen.end(), [&](const OrientedBox& box) { return box.contains(p); })) continue;
      // The noise of the outer faces is no hidden part: both boxes count without their shells.
      OrientedBox inner = real, claimed = complete[r];
      inner.half_size = (inner.half_size.array() - kShell).max(0.0);
      claimed.half_size = (claimed.half_size.array() - kShell).max(0.0);
      const bool is_hidden = inner.contains(p), is_claimed = claimed.contains(p);
      score.hidden += is_hidden * cell;
      score.extension += is_claimed * cell;
      // What is in one box but in the other's shell only is neither right nor wrong.
      both += ((is_hidden && complete[r].contains(p)) || (is_claimed && real.contains(p))) * cell;
      either += (is_hidden || is_claimed) * cell;
    }
  }
  score.iou = either > 0 ? both / either : 1.0;
  return score;
}

Evaluation evaluate(const Completion& result, const EvaluateOptions& options, Context& context) {
  check(result, options);
  Evaluation e;
  e.cuboids = result.cuboids.size();
  if (options.referee && has_referee()) e.referee = ask_referee(result, options, context);
  if (options.referee && !has_referee()) context.warn("built without MuJoCo: nothing says whether the result stands");
  return e;
}

Evaluation evaluate(const Completion& result, const Truth& given, const EvaluateOptions& options, Context& context) {
  check(given);
  Evaluation e = evaluate(result, options, context);
  const Truth truth = moved_to_result(given, result);
  const Matching matching = match_cuboids(result, truth);
  e.true_cuboids = truth.cuboids.size();
  e.found = static_cast<std::size_t>(
      std::count_if(matching.pieces.begin(), matching.pieces.end(), [](const auto& pieces) { return !pieces.empty(); }));
  e.contacts_before = score_contacts(initial_contacts(result, options.tolerance), result, truth, matching);
  e.contacts_after = score_contacts(result.contacts, result, truth, matching);
  score_sizes(result, truth, matching, e);
  if (truth.cuboids.front().box) {
    e.pose = score_pose(result, truth, matching);
    e.hidden_part = score_hidden_part(result, truth, matching);
  }
  return e;
}

}  // namespace unseen::cuboids
