// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/doubt.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "planes/scan/weighted.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kFewestTilts = 10;
constexpr std::size_t kFewestMembers = 3;  // of a frame that tells
constexpr double kTelling = 0.1;         // of a tilt's variance: what is left where the frame follows it
constexpr double kPrecise = 0.3;         // of the systematic doubt: noise that does not hide it
constexpr double kQuantile = 0.75, kUsual = 1.32;  // the square of a standard normal variable is below this so often; tails are heavy
constexpr double kMuchLess = 0.6, kLeast = 0.1;  // of the doubt at first: when to look again, and what is left at least
constexpr int kAgain = 3;  // what was in the largest frame by chance leaves it, and then more of the doubt goes
constexpr double kGoesOn = 0.2;    // rad: between patches that go on in each other
constexpr double kMeant = 9;       // times the doubt's variance: an edge of another angle
constexpr double kRough = 2;       // times the typical noise: two sides of a wall, or more than one thing
constexpr double kFewPoints = 15;  // of these, clutter at a rim is a part that large walls do not show

/// Brings the systematic doubt of every patch from one share of its standard deviation at first to another. What is small or rough keeps more.
void reduce_doubt(Patches& patches, double from, double to) {
  std::vector<std::pair<double, double>> noise;
  for (const Patch& patch : patches.patches) noise.emplace_back(patch.fit.rms, patch.area);
  const double typical = weighted_quantile(std::move(noise), 0.5);
  for (Patch& patch : patches.patches) {
    const double least = patch.fit.rms > kRough * typical ? 1.0 : std::min(1.0, kFewPoints / patch.moments.count);
    const double kept = std::max(to * to, least) / std::max(from * from, least);
    const auto reduce = [&](double& doubt, double& systematic) {
      if (!std::isfinite(systematic)) return;  // points in a line say nothing about one of the tilts
      doubt -= (1 - kept) * systematic;
      systematic *= kept;
    };
    reduce(patch.doubt_u, patch.systematic_u);
    reduce(patch.doubt_v, patch.systematic_v);
  }
}

/// Adds the squared tilts of a frame's members against the frame that fits them by their areas (what is in it by chance is small, and must not
/// turn it), over the variance that they would have at the systematic doubt: a tilt that turns the frame along with itself shows the less of it.
void add_squares(const OrientationFrame& start, const std::vector<Vec3>& locals, const std::vector<std::pair<const Patch*, int>>& members,
                 std::vector<std::pair<double, double>>& squares) {
  const OrientationFrame frame = refit_frame(start, locals, members, /*by_area=*/true);
  struct Tilt {
    Vec3 jacobian;
    double square, variance, weight, area;
    bool tells;
  };
  std::vector<Tilt> tilts;
  Mat3 information = Mat3::Zero(), spread = Mat3::Zero();
  for (const auto& [patch, local] : members) {
    const Vec3 n = frame.direction(locals[local]);
    const double across = std::abs(n.dot(patch->fit.normal));
    for (const auto& [axis, doubt, systematic] : {std::tuple(patch->fit.u, patch->doubt_u, patch->systematic_u), {patch->fit.v, patch->doubt_v, patch->systematic_v}}) {
      if (!(systematic > 0) || !std::isfinite(doubt)) continue;
      const Tilt& t = tilts.emplace_back(n.cross(axis), std::pow(n.dot(axis) / across, 2), systematic, patch->area / doubt, patch->area, doubt - systematic < kPrecise * systematic);
      information += t.weight * t.jacobian * t.jacobian.transpose();
      spread += t.weight * t.weight * t.variance * t.jacobian * t.jacobian.transpose();
    }
  }
  const Mat3 covariance = information.completeOrthogonalDecomposition().pseudoInverse(), turn = covariance * spread * covariance;
  for (const Tilt& t : tilts) {
    const double left = t.variance * (1.0 - 2.0 * t.weight * t.jacobian.dot(covariance * t.jacobian)) + t.jacobian.dot(turn * t.jacobian);
    if (t.tells && left > kTelling * t.variance) squares.emplace_back(t.square / left, t.area);
  }
}

/// The doubt that squares of deviations tell, each over what it would be at the systematic doubt, with an area.
double doubt_of(std::vector<std::pair<double, double>> squares) {
  if (squares.size() < kFewestTilts) return 1.0;
  const double safety = 2 + 4 / std::sqrt(static_cast<double>(squares.size()));
  return std::clamp(safety * std::sqrt(weighted_quantile(std::move(squares), kQuantile) / kUsual), kLeast, 1.0);
}

/// Variance (rad²) of a patch's tilt about an axis in it. A line's tilt out of its drawing has none that is finite, and no share.
double variance_about(const Patch& patch, const Vec3& axis, double variance_u, double variance_v) {
  const Vec3 tilt = axis.cross(patch.fit.normal);
  const double u = std::pow(tilt.dot(patch.fit.u), 2), v = std::pow(tilt.dot(patch.fit.v), 2);
  return (u > 1e-12 ? u * variance_u : 0) + (v > 1e-12 ? v * variance_v : 0);
}

}  // namespace

double shown_doubt(const Patches& patches, const Selection& s, const std::vector<Vec3>& locals) {
  std::vector<std::vector<std::pair<const Patch*, int>>> members(s.frames.size());
  for (std::size_t j = 0; j < patches.patches.size(); ++j)
    if (!patches.patches[j].bowed) members[static_cast<std::size_t>(s.frame_of_patch[j])].emplace_back(&patches.patches[j], s.local_of_patch[j]);
  std::vector<std::pair<double, double>> squares;  // of tilts, over what they would be at the systematic doubt; the patch's area
  for (std::size_t f = 0; f < s.frames.size(); ++f)
    if (members[f].size() >= kFewestMembers) add_squares(s.frames[f], locals, members[f], squares);
  return doubt_of(std::move(squares));
}

double doubt_at_edges(const Patches& patches, const AngleSet& angles) {
  std::vector<std::pair<double, double>> squares;
  for (const auto& [a, b] : patches.adjoining) {
    const Patch &pa = patches.patches[a], &pb = patches.patches[b];
    const double angle = line_angle(pa.fit.normal, pb.fit.normal);
    if (angle < kGoesOn || pa.bowed || pb.bowed) continue;
    const Vec3 axis = pa.fit.normal.cross(pb.fit.normal).normalized();
    double systematic = 0, noise = 0;
    for (const Patch* p : {&pa, &pb}) {
      systematic += variance_about(*p, axis, p->systematic_u, p->systematic_v);
      noise += variance_about(*p, axis, p->doubt_u - p->systematic_u, p->doubt_v - p->systematic_v);
    }
    const double square = std::pow(angles.deviation(angle), 2);
    if (!(noise < kPrecise * systematic) || square > kMeant * systematic) continue;
    squares.emplace_back(square / systematic, std::min(pa.area, pb.area));
  }
  return doubt_of(std::move(squares));
}

Selection select_as_built(Patches& patches, const AngleSet& angles, const Space& space, const Options& options, Context& context) {
  Options local = options;
  local.solver = "local";
  Selection selection = select_frames(patches, angles, space, local, context);
  if (selection.local_fits) return selection;
  double doubt = 1;
  for (int again = 0; again < kAgain && doubt > kLeast; ++again) {
    const double shown = std::min(shown_doubt(patches, selection, local_directions(angles, space)), doubt_at_edges(patches, angles));
    if (shown > kMuchLess) break;
    const double less = std::max(kLeast, doubt * shown);
    reduce_doubt(patches, doubt, less);
    doubt = less;
    selection = select_frames(patches, angles, space, local, context);
  }
  if (options.solver != local.solver) selection = select_frames(patches, angles, space, options, context);
  state_bound(selection, context);
  share_out(patches, angles, space, options, context, selection);
  return selection;
}

}  // namespace unseen::planes
