// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/arrange.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr double kThick = 4.0;                // times the typical noise
constexpr double kInSheet = 3.0;              // times the noise, off the sheet
constexpr std::size_t kFewestOnSheet = 60;    // points
constexpr int kTries = 100;
constexpr double kMostOfPoints = 0.5;         // of the points: less is clutter
constexpr double kAllOver = 0.8;              // of the spread of all points: less is a step
constexpr double kWorth = 0.7 * kPi / 180.0;  // rad, that the sheet is turned from where the surface is held
constexpr double kTurned = 20 * kPi / 180.0;  // rad, from all points: more is something else

/// The points near the plane that most of them are near, if it reaches all over them.
std::vector<Vec3> main_sheet(const std::vector<Vec3>& points, const PlaneFit& all, double noise, const Space& space) {
  Random random(1);
  const auto near = [&](const Vec3& normal, const Vec3& at) {
    std::vector<Vec3> found;
    for (const Vec3& p : points)
      if (std::abs(normal.dot(p - at)) < kInSheet * noise) found.push_back(p);
    return found;
  };
  std::size_t most = 0;
  Vec3 normal_of_most = all.normal, at = points.front();
  for (int i = 0; i < kTries; ++i) {
    const Vec3 &a = points[random.index(points.size())], &b = points[random.index(points.size())], &c = points[random.index(points.size())];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    if (!(line_angle(normal, all.normal) < kTurned)) continue;
    const auto count = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return std::abs(normal.dot(p - a)) < kInSheet * noise; }));
    if (count > most) most = count, normal_of_most = normal, at = a;
  }
  std::vector<Vec3> best = near(normal_of_most, at);
  for (int round = 0; round < 3 && best.size() >= kFewestOnSheet; ++round) {
    Moments m;
    for (const Vec3& p : best) m += Moments{1.0, p, Mat3::Zero()};
    best = near(fit_plane(m, space).normal, m.mean);
  }
  return best;
}

}  // namespace

void keep_main_sheets(Model& model, const Survey& survey, const VoxelGrid& grid, const Space& space, double noise, double tolerance, const Context& context) {
  if (space.is_2d()) return;
  const auto is_thick = [&](const Surface& s) { return s.support.fit.rms > kThick * noise; };
  if (std::none_of(model.surfaces.begin(), model.surfaces.end(), is_thick)) return;
  std::vector<int> surface_of(grid.size(), -1);
  for (const Part& part : model.parts)
    if (is_thick(model.surfaces[part.surface]))
      for (const int i : part.cells) surface_of[i] = part.surface;
  std::vector<std::vector<Vec3>> points(model.surfaces.size());
  for (const Vec3& p : survey.sample) {
    const int voxel = grid.find(grid.key_of(p));
    if (voxel < 0 || surface_of[voxel] < 0) continue;
    const Surface& s = model.surfaces[surface_of[voxel]];
    if (std::abs(model.normal(s).dot(p) - s.offset) < tolerance) points[surface_of[voxel]].push_back(p);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].size() < kFewestOnSheet) continue;
    context.check();
    Patch& support = model.surfaces[k].support;
    const std::vector<Vec3> sheet = main_sheet(points[k], support.fit, noise, space);
    if (sheet.size() < kFewestOnSheet || static_cast<double>(sheet.size()) < kMostOfPoints * static_cast<double>(points[k].size())) continue;
    Moments m;
    for (const Vec3& p : sheet) m += Moments{1.0, p, Mat3::Zero()};
    const PlaneFit fit = fit_plane(m, space);
    if (line_angle(fit.normal, model.normal(model.surfaces[k])) < kWorth) continue;
    if (fit.spread_u < kAllOver * support.fit.spread_u || fit.spread_v < kAllOver * support.fit.spread_v) continue;
    m.count /= survey.share, m.scatter /= survey.share;
    support.moments = m;
    support.fit = fit;
    support.variance_u = std::pow(std::max(fit.rms, 0.5 * noise) / fit.spread_u, 2) / std::min(m.count, kMostPoints);
    support.variance_v = std::pow(std::max(fit.rms, 0.5 * noise) / fit.spread_v, 2) / std::min(m.count, kMostPoints);
  }
}

}  // namespace unseen::planes
