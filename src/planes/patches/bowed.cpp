// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Patches of curved surfaces: each is bent as the turn to its neighbour asks for, where planes are flat up to the edge between them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/linear.h"
#include "planes/patches/patches.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kFewestVoxels = 8;      // that tell a bend,
constexpr double kFewestOfBend = 12.0;         // and points
constexpr double kLeastTurn = 3.0 * kPi / 180.0, kMostTurn = 75.0 * kPi / 180.0;  // between strips of one surface
constexpr double kAcross = 5.0 * kPi / 180.0;  // by which one turns at its ends against its middle, at least: a wall that bulges turns by less
constexpr double kLikelier = 6.0, kHardly = 1.0;  // the log likelihood of bent against flat that is asked for; beside a bowed patch
constexpr double kMost = 2.5;                  // times as bent as the turn asks for at most
constexpr double kCorrelated = 2.0;            // variance of a bend by noise, over that of independent points
constexpr double kHalf = 1.73205080756887729;  // √3: half an extent over its spread, of evenly spread points
constexpr int kRounds = 4;                     // in which what lies beside a bowed patch, or between two and does not say that it is flat, joins them
constexpr double kFlat = 3.0;                  // σ between its bend and what the turn asks for that do not say so

using Six = Eigen::Matrix<double, 6, 1>;

/// w ≈ a + b·(u, v) + ½ (u, v) H (u, v)ᵀ of a patch's points over its plane.
struct Bend {
  Eigen::Matrix2d h;           ///< H, 1/m
  Eigen::Matrix3d covariance;  ///< of H_uu, H_uv and H_vv
  bool known = false;

  double along(const Eigen::Vector2d& e) const { return e.dot(h * e); }
  double variance_along(const Eigen::Vector2d& e) const {
    const Vec3 c(e.x() * e.x(), 2.0 * e.x() * e.y(), e.y() * e.y());
    return c.dot(covariance * c);
  }
};

/// Points count as no less noisy than `least_noise` (m).
Bend bend_of(const VoxelGrid& grid, const Patch& patch, double least_noise) {
  Bend bend;
  if (patch.cells.size() < kFewestVoxels) return bend;
  const PlaneFit& fit = patch.fit;
  const double unit = std::max(fit.spread_u, 1e-300);  // of u and v, so that the equations are well conditioned
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Six right = Six::Zero();
  double squares = 0, count = 0;
  for (const int i : patch.cells) {
    const Moments& m = grid.moments[i];
    const Vec3 d = m.mean - patch.moments.mean;
    const double u = d.dot(fit.u) / unit, v = d.dot(fit.v) / unit, off = d.dot(fit.normal);
    const Six row = (Six() << 1.0, u, v, 0.5 * u * u, u * v, 0.5 * v * v).finished();
    normal += m.count * row * row.transpose();
    right += m.count * off * row;
    squares += m.count * off * off + fit.normal.dot(m.scatter * fit.normal);
    count += m.count;
  }
  if (count < kFewestOfBend) return bend;
  const Six x = solve_symmetric<6>(normal, right);
  const double variance = kCorrelated * std::max((squares - x.dot(right)) / (count - 6.0), least_noise * least_noise);
  for (int k = 0; k < 3; ++k) bend.covariance.col(k) = variance / std::pow(unit, 4) * solve_symmetric<6>(normal, Six::Unit(3 + k)).tail<3>();
  bend.h << x[3], x[4], x[4], x[5];
  bend.h /= unit * unit;
  bend.known = bend.h.allFinite() && bend.covariance.allFinite();
  return bend;
}

/// How a patch would be bent if it were of one curved surface with another.
struct Turn {
  Eigen::Vector2d towards;  ///< the other, unit, along u and v
  double bend;              ///< 1/m, along that
};

/// None where the two cannot be of one, or where that would turn the patch too little to tell.
std::optional<Turn> turn_to(const Patch& other, const Patch& patch) {
  const double angle = line_angle(patch.fit.normal, other.fit.normal);
  if (angle < kLeastTurn || angle > kMostTurn) return std::nullopt;
  Turn turn;
  const Vec3 apart = other.moments.mean - patch.moments.mean;
  turn.towards = {apart.dot(patch.fit.u), apart.dot(patch.fit.v)};
  if (!(turn.towards.norm() > 0.0)) return std::nullopt;
  turn.towards.normalize();
  const Vec3 e = turn.towards.x() * patch.fit.u + turn.towards.y() * patch.fit.v;
  const double across = patch.fit.normal.dot(other.fit.normal), side = across < 0.0 ? -1.0 : 1.0;
  turn.bend = std::atan2(-side * other.fit.normal.dot(e), std::abs(across)) / apart.norm();
  const double half = kHalf * std::hypot(turn.towards.x() * patch.fit.spread_u, turn.towards.y() * patch.fit.spread_v);
  return std::abs(turn.bend) * half > kAcross ? std::optional(turn) : std::nullopt;
}

/// The log likelihood that a patch is bent as a turn asks for, against flat.
double likelier_bent(const Bend& bend, const Turn& turn) {
  const double along = bend.along(turn.towards), variance = bend.variance_along(turn.towards);
  if (along / turn.bend > kMost || !(variance > 0.0)) return -1.0;  // points in two rows tell no bend across them
  return 0.5 * (along * along - std::pow(along - turn.bend, 2)) / variance;
}

}  // namespace

void mark_bowed(const VoxelGrid& grid, const Context& context, Patches& patches) {
  const std::size_t count = patches.patches.size();
  std::vector<std::vector<int>> beside(count);
  for (const auto& [a, b] : patches.adjoining) beside[a].push_back(b), beside[b].push_back(a);
  std::vector<Bend> bends(count);
  std::vector<char> bowed(count, 0);
  const double least_noise = std::max(patches.least_noise, grid.rounding / std::sqrt(12.0));
  parallel_blocks(context, count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (const int other : beside[j]) {
        const std::optional<Turn> turn = turn_to(patches.patches[other], patches.patches[j]);
        if (!turn) continue;
        if (!bends[j].known) bends[j] = bend_of(grid, patches.patches[j], least_noise);
        if (!bends[j].known) break;
        if (likelier_bent(bends[j], *turn) > kLikelier) bowed[j] = 1;
      }
  });
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<char> before = bowed;
    for (std::size_t j = 0; j < count; ++j) {
      int around = 0;
      for (const int other : beside[j]) {
        if (before[other] == 0) continue;
        const std::optional<Turn> turn = turn_to(patches.patches[other], patches.patches[j]);
        if (!turn) continue;
        if (!bends[j].known) ++around;
        else if (likelier_bent(bends[j], *turn) > kHardly) around += 2;
        else around += std::pow(bends[j].along(turn->towards) - turn->bend, 2) < kFlat * kFlat * bends[j].variance_along(turn->towards);
      }
      if (around > 1) bowed[j] = 1;
    }
  }
  for (std::size_t j = 0; j < count; ++j) patches.patches[j].bowed = bowed[j] != 0;
}

}  // namespace unseen::planes
