// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "planes/relations/reconcile.h"

namespace unseen::planes {
namespace {

/// Patches of one orientation that adjoin within the scale and are not clearly apart, as groups; each is named by its largest patch.
std::vector<int> join_coplanar(const Patches& patches, const std::vector<Vec3>& normals, const VoxelGrid& grid, const Cells& cells) {
  constexpr double kClearly = 4.0;  // times the noise,
  constexpr double kRounded = 3.0, kLeast = 0.01;  // the steps of coordinates, and of the tolerance
  const std::size_t n = patches.patches.size();
  std::vector<int> group(n);
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int j) {
    while (group[j] != j) j = group[j] = group[group[j]];
    return j;
  };
  std::vector<Moments> sums(n);
  for (std::size_t j = 0; j < n; ++j) sums[j] = patches.patches[j].moments;
  const auto gap = [&](int a, int b) { return std::abs(normals[a].dot(sums[a].mean - sums[b].mean)); };
  struct Join {
    double gap;
    int a, b;
  };
  std::vector<Join> joins;
  for (const auto& [a, b] : patches.adjoining)
    if (line_angle(normals[a], normals[b]) < 1e-7) joins.push_back({gap(a, b), a, b});
  std::stable_sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.gap < b.gap; });
  const auto tolerance = [&](int j) { return cells.tolerance[patches.patches[j].cells.front()]; };
  for (const Join& join : joins) {
    const int a = root(join.a), b = root(join.b);
    const double noise = std::max(patches.patches[join.a].fit.rms, patches.patches[join.b].fit.rms);
    if (a == b || gap(a, b) >= std::min({tolerance(join.a), tolerance(join.b), std::max({kClearly * noise, kRounded * grid.rounding, kLeast * grid.tolerance})})) continue;
    group[std::max(a, b)] = std::min(a, b);
    sums[std::min(a, b)] += sums[std::max(a, b)];
  }
  for (std::size_t j = 0; j < n; ++j) group[j] = root(static_cast<int>(j));
  return group;
}

/// Covariance (rad²) of each frame's turn, as far as its patches tell; of correlated noise no patch averages much away.
std::vector<Mat3> turn_covariances(const std::vector<Patch>& patches, const std::vector<Vec3>& normals, const std::vector<int>& frame, std::size_t frames) {
  constexpr double kLoose = 0.1, kLeastTilt = 1e-5;  // rad: what no patch tells; no patch tells more
  std::vector<Mat3> information(frames, Mat3::Identity() / (kLoose * kLoose));
  for (std::size_t j = 0; j < patches.size(); ++j) {
    const Patch& p = patches[j];
    if (p.cells.empty()) continue;
    const auto noise = [&](double doubt, double systematic) { return doubt - systematic + kLeastTilt * kLeastTilt; };
    for (const TiltResidual& r : tilt_residuals(p.fit, normals[j], noise(p.doubt_u, p.systematic_u), noise(p.doubt_v, p.systematic_v)))
      if (std::isfinite(r.weight)) information[frame[j]] += r.weight * r.jacobian * r.jacobian.transpose();
  }
  for (Mat3& m : information) m = m.inverse().eval();
  return information;
}

/// Gives parts of one direction whose offsets do not differ significantly one surface, the largest part first. What its frame turns out of its own points shares
/// one only with what is turned alike: together with others it would hide how far.
void share_surfaces(const Patches& known, const std::vector<Vec3>& normals, const VoxelGrid& grid, const Cells& surface, const Space& space,
                    const std::vector<int>& frame, const std::vector<int>& local, std::vector<std::vector<int>> cells,
                    Model& model, const Context& context) {
  constexpr double kExact = 0.003;    // of the tolerance: what differs by less is the same
  constexpr double kAlike = 1.1;      // times the squared error of a plane each is left by one plane for both: turned alike
  struct Sum {
    Moments moments;
    double variance;  // m², of the offset
    Vec3 normal;
    std::vector<std::size_t> patches;
    bool turned_out;
  };
  std::vector<Patch> patches(cells.size());
  parallel_blocks(context, cells.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      if (!cells[j].empty()) {
        patches[j] = make_patch(grid, space, std::move(cells[j]), known.least_noise, surface);
        patches[j].bowed = known.patches[j].bowed;
        patches[j].waves = known.patches[j].waves;
        add_waves(known.waves, patches[j]);
      }
  });
  const std::vector<Mat3> turns = turn_covariances(patches, normals, frame, model.frames.size());
  std::vector<Sum> sums;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Patch& patch = patches[j];
    if (patch.cells.empty()) continue;
    const double variance = std::pow(kExact * grid.tolerance, 2) + std::pow(patch.fit.rms, 2) / std::min(kMostPoints, patch.moments.count);
    const bool turned_out = !space.is_2d() && is_turned_out(model, patch, normals[j]);
    int to = -1;
    double nearest = 0.5 * grid.tolerance;
    const auto turned_alike = [&](const Sum& sum) {
      Moments both = sum.moments;
      both += patch.moments;
      return squared_error(both, space) < kAlike * (squared_error(sum.moments, space) + squared_error(patch.moments, space));
    };
    for (std::size_t s = 0; s < sums.size(); ++s) {
      if (line_angle(sums[s].normal, normals[j]) > 1e-7) continue;
      const Vec3 apart = patch.moments.mean - sums[s].moments.mean, lever = normals[j].cross(apart);
      const double limit = 3.0 * std::sqrt(variance + sums[s].variance + lever.dot(turns[frame[j]] * lever));
      const double offset = std::abs(normals[j].dot(apart));
      if (offset < std::min(nearest, limit) && (!(turned_out || sums[s].turned_out) || turned_alike(sums[s]))) to = static_cast<int>(s), nearest = offset;
    }
    if (to < 0) {
      to = static_cast<int>(sums.size());
      sums.push_back({{}, variance, normals[j], {}, turned_out});
      model.surfaces.push_back({frame[j], local[j], {}, 0.0});
    }
    sums[to].moments += patch.moments;
    sums[to].patches.push_back(j);
    model.parts.push_back({to, patch.cells});
  }
  parallel_blocks(context, sums.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      Patch& support = model.surfaces[s].support;
      support = std::move(patches[sums[s].patches.front()]);
      if (sums[s].patches.size() == 1) continue;
      std::vector<int> all = std::move(support.cells);
      for (std::size_t k = 1; k < sums[s].patches.size(); ++k) {
        const std::vector<int>& more = patches[sums[s].patches[k]].cells;
        all.insert(all.end(), more.begin(), more.end());
      }
      std::sort(all.begin(), all.end());
      const bool bowed = support.bowed;
      const double share = support.waves;
      support = make_patch(grid, space, std::move(all), known.least_noise, surface);
      support.bowed = bowed;
      support.waves = share;
      add_waves(known.waves, support);
    }
  });
}

/// Lets patches go with the largest one of their orientation that they adjoin, if that was set free and its own suits them: panes stay parallel to their wall.
void follow_freed(const Patches& patches, const std::vector<int>& frame, const std::vector<int>& local, Model& model) {
  constexpr double kSuits = 4.0;  // χ²: two standard errors
  std::vector<int> leader(patches.patches.size(), -1);
  for (const auto& [a, b] : patches.neighbours)  // a is no smaller than b; sorted, so that the largest comes first
    if (leader[b] < 0 && !patches.patches[a].bowed && !patches.patches[b].bowed && frame[a] == frame[b] && local[a] == local[b]) leader[b] = a;
  for (int j = static_cast<int>(leader.size()) - 1; j >= 0; --j) {  // whom a patch follows comes before it, and has not followed anybody yet
    if (leader[j] < 0) continue;
    const Surface& ahead = model.surfaces[leader[j]];
    Surface& own = model.surfaces[j];
    if (ahead.frame == frame[leader[j]] || own.frame != frame[j]) continue;
    const Patch& patch = patches.patches[j];
    const Vec3 n = model.normal(ahead);
    if (tilt_chi2(patch, n) < kSuits && noise_chi2(patch, n) < noise_chi2(patch, model.normal(own)) + kSuits) own.frame = ahead.frame, own.local = ahead.local;
  }
}

/// Sets patches free that their frame would turn out of their own points: joined with others, they would hide it.
void hold_patches(const Patches& patches, double tolerance, const Space& space, Model& model, std::vector<int>& frame, std::vector<int>& local) {
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    Patch& known = model.surfaces.emplace_back(Surface{frame[j], local[j], {}, 0.0}).support;  // without its cells
    known.moments = patch.moments;
    known.fit = patch.fit;
    known.variance_u = patch.variance_u;
    known.variance_v = patch.variance_v;
    known.bowed = patch.bowed;
  }
  refit_held(model, tolerance, space);
  follow_freed(patches, frame, local, model);
  for (std::size_t j = 0; j < model.surfaces.size(); ++j) frame[j] = model.surfaces[j].frame, local[j] = model.surfaces[j].local;
  model.surfaces.clear();
}

}  // namespace

Model build_model(const Selection& selection, const Patches& patches, const VoxelGrid& grid, const Cells& cells,
                  const AngleSet& angles, const Space& space, Context& context) {
  Model model;
  model.locals = local_directions(angles, space);
  Reconciled r = reconcile(selection, patches, model.locals, angles, space);
  context.check();
  model.frames = std::move(r.frames);
  model.constraints = std::move(r.constraints);
  model.local_fits = selection.local_fits;
  // Scans that make a drawing are turned against each other, which no line's own points tell of; pixels are not.
  if (space.is_2d() && grid.pixel == 0.0) model.certain = std::numeric_limits<double>::infinity();
  else model.certain = certain_at(selection.lambda);

  if (!space.is_2d() && !model.local_fits) hold_patches(patches, grid.tolerance, space, model, r.frame_of_patch, r.local_of_patch);
  std::vector<Vec3> normals;
  for (std::size_t j = 0; j < patches.patches.size(); ++j)
    normals.push_back(model.frames[r.frame_of_patch[j]].direction(model.locals[r.local_of_patch[j]]));
  const std::vector<int> group = join_coplanar(patches, normals, grid, cells);
  std::vector<std::vector<int>> cells_of(patches.patches.size());
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const std::vector<int>& c = patches.patches[j].cells;
    cells_of[group[j]].insert(cells_of[group[j]].end(), c.begin(), c.end());
  }
  for (std::vector<int>& c : cells_of) std::sort(c.begin(), c.end());
  share_surfaces(patches, normals, grid, cells, space, r.frame_of_patch, r.local_of_patch, std::move(cells_of), model,
                 context);
  return model;
}

}  // namespace unseen::planes
