// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/select.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "core/linear.h"
#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kFirstRound = 80;  // patches that are selected at once, at least
constexpr double kExplained = 0.05;       // data cost below which a patch asks for no new frame

/// Patches of each round, the largest first: the area threshold is halved until none is left. Bowed ones are in none.
std::vector<std::vector<int>> rounds_by_area(const Patches& patches) {
  std::vector<int> flat;
  for (std::size_t j = 0; j < patches.patches.size(); ++j)
    if (!patches.patches[j].bowed) flat.push_back(static_cast<int>(j));
  const auto area = [&](std::size_t i) { return patches.patches[flat[i]].area; };
  std::vector<std::vector<int>> rounds;
  std::size_t at = 0;
  double threshold = flat.empty() ? 0 : area(0);
  while (at < flat.size()) {
    std::vector<int> round;
    const std::size_t least = rounds.empty() ? kFirstRound : 1;
    while (at < flat.size() && (round.size() < least || area(at) > threshold)) {
      threshold = std::min(threshold, area(at));
      round.push_back(flat[at++]);
    }
    threshold *= 0.5;
    rounds.push_back(std::move(round));
  }
  return rounds;
}

/// Energy of giving every patch a frame of its own.
Energy keep_local_fits(const Patches& patches, const AngleSet& angles, const Space& space,
                       const std::vector<Vec3>& locals, double lambda, const Context& context) {
  if (lambda == 1.0) return {};
  std::vector<OrientationFrame> frames;
  for (const Patch& p : patches.patches)
    if (!p.bowed) frames.push_back(open_frame(p.fit.normal, space));
  Energy e;
  double pairs = 0;
  std::vector<double> with(frames.size());  // added one by one: the sum is the same on any number of threads
  for (std::size_t a = 0; a < frames.size(); ++a) {
    parallel_blocks(context, a, 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) with[b] = irregularity(frames[a], frames[b], locals, angles);
    });
    for (std::size_t b = 0; b < a; ++b) pairs += with[b];
  }
  e.irregularity = (1.0 - lambda) * irregularity_cost(pairs);
  for (const auto& [a, b] : patches.neighbours)
    if (!patches.patches[a].bowed && !patches.patches[b].bowed && line_angle(patches.patches[a].fit.normal, patches.patches[b].fit.normal) > kSameOrientation)
      e.smoothness += (1.0 - lambda) / 10.0;
  return e;
}

/// The frames that labels use, refitted to the patches that have them.
std::vector<OrientationFrame> refit_used(const Patches& patches, const std::vector<int>& members,
                                         const std::vector<OrientationFrame>& frames, std::size_t fixed,
                                         const Labels& labels, const std::vector<Vec3>& locals,
                                         double patch_angle) {
  std::vector<OrientationFrame> refitted;
  for (std::size_t k = fixed; k < frames.size(); ++k) {
    std::vector<std::pair<const Patch*, int>> of_frame;
    for (std::size_t i = 0; i < members.size(); ++i)
      if (labels[i] == static_cast<int>(k)) {
        const Patch& patch = patches.patches[members[i]];
        of_frame.emplace_back(&patch, best_candidate(patch, frames[k], locals, patch_angle).local);
      }
    if (!of_frame.empty()) refitted.push_back(refit_frame(frames[k], locals, of_frame));
  }
  return refitted;
}

/// Members that no frame explains yet.
std::vector<int> unexplained(const Patches& patches, const std::vector<int>& members, const std::vector<OrientationFrame>& frames,
                             const std::vector<Vec3>& locals, double patch_angle) {
  std::vector<int> result;
  for (const int j : members)
    if (std::none_of(frames.begin(), frames.end(), [&](const OrientationFrame& f) { return best_candidate(patches.patches[j], f, locals, patch_angle).cost < kExplained; }))
      result.push_back(j);
  return result;
}

/// Frames to choose from, fixed ones first, and the frame that each member of a round has.
struct Round {
  std::vector<OrientationFrame> frames;
  SelectionProblem problem;
  Labels labels;
};

/// Chooses among frames, fits the chosen ones to their patches and chooses again, while that lowers the energy (as PEARL does).
Round choose_frames(const Patches& patches, const std::vector<int>& members, std::vector<OrientationFrame> frames, std::size_t fixed, const AngleSet& angles,
                    const std::vector<Vec3>& locals, double lambda, double patch_angle, const Context& context) {
  Round best{std::move(frames), {}, {}};
  best.problem = make_problem(patches, members, best.frames, fixed, angles, locals, lambda, patch_angle, {}, context);
  best.labels = solve_local(best.problem, context);
  for (int i = 0; i < 3; ++i) {
    Round next{best.frames, {}, {}};
    for (OrientationFrame& f : refit_used(patches, members, best.frames, fixed, best.labels, locals, patch_angle)) next.frames.push_back(std::move(f));
    next.problem = make_problem(patches, members, next.frames, fixed, angles, locals, lambda, patch_angle, best.problem, context);
    next.labels = solve_local(next.problem, context, best.labels);
    if (energy_of(next.problem, next.labels).total() > energy_of(best.problem, best.labels).total() - 1e-9) break;
    best = std::move(next);
  }
  return best;
}

/// Adds what a round costs, and returns it. What fixed frames cost among themselves was counted in the rounds that chose them.
double add_energy(const Round& round, std::size_t fixed, Selection& s) {
  const Energy e = energy_of(round.problem, round.labels);
  double pairs = 0;
  for (std::size_t a = 0; a < fixed; ++a)
    for (std::size_t b = 0; b < a; ++b) pairs += round.problem.irregularity(a, b);
  const double among_fixed = round.problem.of_pairs(pairs);
  s.after.data += e.data;
  s.after.irregularity += e.irregularity - among_fixed;
  s.after.smoothness += e.smoothness;
  s.bound -= among_fixed;
  return e.total();
}

/// Appends the frames that a round's members use to those of the selection.
void keep_used(const Patches& patches, const std::vector<int>& members, const Round& round, std::size_t fixed, const std::vector<Vec3>& locals, double patch_angle, Selection& s) {
  std::vector<int> kept(round.frames.size(), -1);
  for (std::size_t k = 0; k < fixed; ++k) kept[k] = static_cast<int>(k);
  for (std::size_t i = 0; i < members.size(); ++i) {
    int& to = kept[round.labels[i]];
    if (to < 0) {
      to = static_cast<int>(s.frames.size());
      s.frames.push_back(round.frames[round.labels[i]]);
    }
    s.frame_of_patch[members[i]] = to;
    s.local_of_patch[members[i]] = best_candidate(patches.patches[members[i]], s.frames[to], locals, patch_angle).local;
  }
}

}  // namespace

OrientationFrame refit_frame(const OrientationFrame& frame, const std::vector<Vec3>& locals,
                             const std::vector<std::pair<const Patch*, int>>& members, bool by_area) {
  OrientationFrame result = frame;
  for (int iteration = 0; iteration < 5; ++iteration) {
    Mat3 information = Mat3::Zero();
    Vec3 gradient = Vec3::Zero();
    for (const auto& [patch, local] : members)
      for (const TiltResidual& r :
           tilt_residuals(patch->fit, result.direction(locals[local]), patch->doubt_u, patch->doubt_v)) {
        const double weight = by_area ? r.weight * patch->area : r.weight;
        information += weight * r.jacobian * r.jacobian.transpose();
        gradient -= weight * r.value * r.jacobian;
      }
    const SymmetricEigen<3> eigen = symmetric_eigen(information);
    Vec3 w = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      if (eigen.values[i] > 1e-9 * eigen.values[2])
        w += eigen.vectors.col(i) * eigen.vectors.col(i).dot(gradient) / eigen.values[i];
    result.axes = turned(result.axes, w);
    if (w.norm() < 1e-12) break;
  }
  return result;
}

Selection select_frames(const Patches& patches, const AngleSet& angles, const Space& space,
                        const Options& options, Context& context) {
  const std::vector<Vec3> locals = local_directions(angles, space);
  const double lambda = options.lambda, patch_angle = radians(options.patch_angle);
  Selection s;
  s.lambda = lambda;
  s.frame_of_patch.assign(patches.patches.size(), -1);
  s.local_of_patch.assign(patches.patches.size(), -1);
  s.before = keep_local_fits(patches, angles, space, locals, lambda, context);

  if (lambda == 1.0) {
    s.local_fits = true;
    for (std::size_t j = 0; j < patches.patches.size(); ++j) {
      s.frames.push_back(open_frame(patches.patches[j].fit.normal, space));
      s.frame_of_patch[j] = static_cast<int>(j);
      s.local_of_patch[j] = 0;
    }
    return s;
  }
  const auto started = std::chrono::steady_clock::now();
  std::size_t done = 0;
  for (const std::vector<int>& members : rounds_by_area(patches)) {
    context.progress(static_cast<double>(done) / patches.patches.size());
    done += members.size();
    const std::size_t fixed = s.frames.size();
    std::vector<OrientationFrame> frames = s.frames;
    for (OrientationFrame& f : propose_frames(patches, unexplained(patches, members, s.frames, locals, patch_angle), s.frames, angles, space, patch_angle, context))
      frames.push_back(std::move(f));
    if (s.proposed.empty()) s.proposed = frames;
    Round round = choose_frames(patches, members, std::move(frames), fixed, angles, locals, lambda, patch_angle, context);
    if (options.solver == "exact") {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - started;
      ExactSolution exact = solve_exact(round.problem, round.labels, std::max(0.0, options.time_limit - spent.count()), context);
      round.labels = std::move(exact.labels);
      s.bound += exact.bound;
      s.time_limit = s.time_limit || !exact.proven;
    }
    const double energy = add_energy(round, fixed, s);
    keep_used(patches, members, round, fixed, locals, patch_angle, s);
    if (options.solver != "exact") s.unbounded.emplace_back(std::move(round.problem), energy);
  }
  return s;
}

void state_bound(Selection& s, const Context& context) {
  std::vector<double> bounds(s.unbounded.size());
  parallel_blocks(context, bounds.size(), 1, [&](std::size_t i, std::size_t) {
    const auto& [problem, energy] = s.unbounded[i];
    bounds[i] = lower_bound(problem, energy, context);
  });
  s.bound = std::accumulate(bounds.begin(), bounds.end(), s.bound);
  s.unbounded.clear();
}

}  // namespace unseen::planes
