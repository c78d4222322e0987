// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/select.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kFirstRound = 80;  // patches that are selected at once, at least
constexpr double kExplained = 0.05;       // data cost below which a patch asks for no new frame
constexpr double kSameOrientation = 0.5 * kPi / 180.0;
constexpr double kIndistinct = 4.0;  // χ²: two standard errors
constexpr double kDominant = 1.0 / 3;  // of the area

/// Patches of each round, the largest first: the area threshold is halved until none is left.
std::vector<std::vector<int>> rounds_by_area(const Patches& patches) {
  std::vector<std::vector<int>> rounds;
  std::size_t at = 0;
  double threshold = patches.patches.empty() ? 0 : patches.patches.front().area;
  while (at < patches.patches.size()) {
    std::vector<int> round;
    const std::size_t least = rounds.empty() ? kFirstRound : 1;
    while (at < patches.patches.size() && (round.size() < least || patches.patches[at].area > threshold)) {
      threshold = std::min(threshold, patches.patches[at].area);
      round.push_back(static_cast<int>(at++));
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
  for (const Patch& p : patches.patches) frames.push_back(open_frame(p.fit.normal, space));
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
    if (line_angle(patches.patches[a].fit.normal, patches.patches[b].fit.normal) > kSameOrientation)
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

/// A patch to which a frame offers an orientation.
struct Offered {
  std::size_t patch;
  int local;
};

/// Patches from whose own orientation the one that a frame offers does not differ.
std::vector<Offered> suited_by(const OrientationFrame& frame, const Patches& patches, const std::vector<Vec3>& locals, double patch_angle) {
  std::vector<Offered> suited;
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    const Candidate c = best_candidate(patch, frame, locals, patch_angle);
    if (c.local >= 0 && tilt_chi2(patch, frame.direction(locals[c.local])) < kIndistinct) suited.push_back({j, c.local});
  }
  return suited;
}

/// Adds the proposed frame that suits the most area, if that is much of the whole: the energy may have shared it out among
/// frames that are needed for something else.
void add_dominant_frame(const Patches& patches, const std::vector<Vec3>& locals, double patch_angle, const Context& context, Selection& s) {
  const std::vector<OrientationFrame>& proposed = s.proposed;
  std::vector<double> areas(proposed.size(), 0.0);
  parallel_blocks(context, proposed.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (proposed[k].closed)
        for (const Offered& o : suited_by(proposed[k], patches, locals, patch_angle)) areas[k] += patches.patches[o.patch].area;
  });
  double all = 0;
  for (const Patch& patch : patches.patches) all += patch.area;
  const auto largest = std::max_element(areas.begin(), areas.end());
  if (largest == areas.end() || *largest < kDominant * all) return;
  OrientationFrame frame = proposed[largest - areas.begin()];
  for (int i = 0; i < 3; ++i) {
    std::vector<std::pair<const Patch*, int>> members;
    for (const Offered& o : suited_by(frame, patches, locals, patch_angle)) members.emplace_back(&patches.patches[o.patch], o.local);
    frame = refit_frame(frame, locals, members);
  }
  s.frames.push_back(frame);
}

/// Where several frames offer a patch the orientation that it has, or one from which its own does not differ, the frame that can have
/// the most area takes it, then the one that can have most of what is left: a room keeps its floor when a table shares it, and walls
/// stay together. Lines of a drawing have one angle, and many differ little by chance: they are given no other orientation.
void give_to_largest(const Patches& patches, const std::vector<Vec3>& locals, double patch_angle, const Space& space, Selection& s) {
  std::vector<std::vector<Offered>> offers(s.frames.size());
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    const Vec3 has = s.frames[s.frame_of_patch[j]].direction(locals[s.local_of_patch[j]]);
    for (std::size_t k = 0; k < s.frames.size(); ++k) {
      const Candidate c = best_candidate(patch, s.frames[k], locals, patch_angle);
      if (c.local < 0) continue;
      const Vec3 offered = s.frames[k].direction(locals[c.local]);
      if (line_angle(offered, has) < kSameOrientation || (!space.is_2d() && tilt_chi2(patch, offered) < kIndistinct)) offers[k].push_back({j, c.local});
    }
  }
  std::vector<char> given(patches.patches.size(), 0);
  for (std::size_t round = 0; round < s.frames.size(); ++round) {
    std::size_t largest = 0;
    double most = 0;
    for (std::size_t k = 0; k < s.frames.size(); ++k) {
      double area = 0;
      for (const Offered& o : offers[k])
        if (!given[o.patch]) area += patches.patches[o.patch].area;
      if (area > most) {
        most = area;
        largest = k;
      }
    }
    if (most == 0) break;
    for (const Offered& o : offers[largest]) {
      if (given[o.patch]) continue;
      given[o.patch] = 1;
      s.frame_of_patch[o.patch] = static_cast<int>(largest);
      s.local_of_patch[o.patch] = o.local;
    }
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
    Eigen::SelfAdjointEigenSolver<Mat3> eigen(information);
    Vec3 w = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      if (eigen.eigenvalues()[i] > 1e-9 * eigen.eigenvalues()[2])
        w += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).dot(gradient) / eigen.eigenvalues()[i];
    result.axes = turned(result.axes, w);
    if (w.norm() < 1e-12) break;
  }
  return result;
}

SelectionProblem make_problem(const Patches& patches, const std::vector<int>& members,
                              const std::vector<OrientationFrame>& frames, std::size_t fixed,
                              const AngleSet& angles, const std::vector<Vec3>& locals, double lambda,
                              double patch_angle, const SelectionProblem& known, const Context& context) {
  SelectionProblem p;
  p.lambda = lambda;
  const int rows = static_cast<int>(members.size()), cols = static_cast<int>(frames.size()), old = known.frames();
  p.data.resize(rows, cols);
  p.orientation.setConstant(rows, cols, -1);
  p.irregularity.setZero(cols, cols);
  p.fixed.assign(cols, 0);
  std::fill(p.fixed.begin(), p.fixed.begin() + static_cast<std::ptrdiff_t>(fixed), 1);

  std::vector<Vec3> orientations;
  std::vector<std::vector<int>> orientation_of(cols);  // per frame and local direction
  for (int k = 0; k < cols; ++k)
    for (std::size_t l = 0; l < (frames[k].closed ? locals.size() : 1); ++l) {
      const Vec3 n = frames[k].direction(locals[l]);
      const auto it = std::find_if(orientations.begin(), orientations.end(), [&](const Vec3& o) {
        return std::abs(o.dot(n)) > std::cos(kSameOrientation);
      });
      orientation_of[k].push_back(static_cast<int>(it - orientations.begin()));
      if (it == orientations.end()) orientations.push_back(n);
    }
  if (old > 0) {  // empty matrices do not fit, not even into nothing
    p.data.leftCols(old) = known.data;
    p.orientation.leftCols(old) = known.orientation;
    p.irregularity.topLeftCorner(old, old) = known.irregularity;
  }
  parallel_blocks(context, cols - old, 8, [&](std::size_t begin, std::size_t end) {
    for (int k = old + static_cast<int>(begin); k < old + static_cast<int>(end); ++k) {
      for (int j = 0; j < rows; ++j) {
        const Candidate c = best_candidate(patches.patches[members[j]], frames[k], locals, patch_angle);
        p.data(j, k) = c.cost;
        if (c.local >= 0) p.orientation(j, k) = orientation_of[k][c.local];
      }
      for (int b = 0; b < k; ++b)
        p.irregularity(k, b) = p.irregularity(b, k) = irregularity(frames[k], frames[b], locals, angles);
    }
  });
  std::vector<int> row_of(patches.patches.size(), -1);
  for (int j = 0; j < rows; ++j) row_of[members[j]] = j;
  for (const auto& [a, b] : patches.neighbours)
    if (row_of[a] >= 0 && row_of[b] >= 0) p.neighbours.emplace_back(row_of[a], row_of[b]);
  return p;
}

Selection select_frames(const Patches& patches, const AngleSet& angles, const Space& space,
                        const Options& options, Context& context) {
  const std::vector<Vec3> locals = local_directions(angles, space);
  const double lambda = options.lambda, patch_angle = radians(options.patch_angle);
  Selection s;
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
  for (const std::vector<int>& round : rounds_by_area(patches)) {
    context.progress(static_cast<double>(done) / patches.patches.size());
    done += round.size();
    const std::size_t fixed = s.frames.size();
    std::vector<int> unexplained;
    for (const int j : round) {
      double least = std::numeric_limits<double>::infinity();
      for (const OrientationFrame& f : s.frames)
        least = std::min(least, best_candidate(patches.patches[j], f, locals, patch_angle).cost);
      if (!(least < kExplained)) unexplained.push_back(j);
    }
    std::vector<OrientationFrame> frames = s.frames;
    for (OrientationFrame& f : propose_frames(patches, unexplained, s.frames, angles, space, patch_angle, context))
      frames.push_back(std::move(f));
    if (s.proposed.empty()) s.proposed = frames;
    SelectionProblem problem;
    const auto problem_of = [&](const std::vector<OrientationFrame>& pool) {
      return make_problem(patches, round, pool, fixed, angles, locals, lambda, patch_angle, problem, context);
    };
    problem = problem_of(frames);
    Labels labels = solve_local(problem, context);
    // Fit the chosen frames to their patches and choose again, while that lowers the energy (as PEARL does).
    for (int i = 0; i < 3; ++i) {
      std::vector<OrientationFrame> pool = frames;
      for (OrientationFrame& f : refit_used(patches, round, frames, fixed, labels, locals, patch_angle))
        pool.push_back(std::move(f));
      SelectionProblem next = problem_of(pool);
      Labels again = solve_local(next, context, labels);
      if (energy_of(next, again).total() > energy_of(problem, labels).total() - 1e-9) break;
      frames = std::move(pool);
      problem = std::move(next);
      labels = std::move(again);
    }
    if (options.solver == "exact") {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - started;
      ExactSolution exact = solve_exact(problem, labels, std::max(0.0, options.time_limit - spent.count()), context);
      labels = std::move(exact.labels);
      s.bound += exact.bound;
      s.time_limit = s.time_limit || !exact.proven;
    }
    // What fixed frames cost among themselves was counted in the rounds that chose them.
    const Energy e = energy_of(problem, labels);
    double pairs = 0;
    for (std::size_t a = 0; a < fixed; ++a)
      for (std::size_t b = 0; b < a; ++b) pairs += problem.irregularity(a, b);
    const double among_fixed = problem.of_pairs(pairs);
    s.after.data += e.data;
    s.after.irregularity += e.irregularity - among_fixed;
    s.after.smoothness += e.smoothness;
    s.bound -= among_fixed;
    if (options.solver != "exact") s.unbounded.emplace_back(std::move(problem), e.total());

    std::vector<int> kept(frames.size(), -1);
    for (std::size_t k = 0; k < fixed; ++k) kept[k] = static_cast<int>(k);
    for (std::size_t i = 0; i < round.size(); ++i) {
      int& to = kept[labels[i]];
      if (to < 0) {
        to = static_cast<int>(s.frames.size());
        s.frames.push_back(frames[labels[i]]);
      }
      s.frame_of_patch[round[i]] = to;
      s.local_of_patch[round[i]] = best_candidate(patches.patches[round[i]], s.frames[to], locals, patch_angle).local;
    }
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

void share_out(const Patches& patches, const AngleSet& angles, const Space& space, const Options& options, const Context& context, Selection& s) {
  if (s.local_fits) return;
  const std::vector<Vec3> locals = local_directions(angles, space);
  const double patch_angle = radians(options.patch_angle);
  if (s.frames.size() > 1 && !space.is_2d()) add_dominant_frame(patches, locals, patch_angle, context, s);
  give_to_largest(patches, locals, patch_angle, space, s);
}

}  // namespace unseen::planes
