// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/describe.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "planes/result/outline.h"

namespace unseen::planes {
namespace {

constexpr double kSameDirection = 1e-9;  // rad: shared axes are equal up to rounding

/// A second axis of the plane's frame that lies in the plane, so that outlines follow walls.
Vec3 in_plane_axis(const Model& model, const Surface& surface) {
  const Vec3 n = model.normal(surface);
  const Mat3& axes = model.frames[surface.frame].axes;
  for (int a = 0; a < 3; ++a)
    if (std::abs(axes.col(a).dot(n)) < 1e-9) return axes.col(a);
  return any_orthogonal(n);
}

std::array<Vec3, 2> segment_of(const std::vector<Vec3>& points, const Plane& plane, const Vec3& along, double edge) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    low = std::min(low, along.dot(p));
    high = std::max(high, along.dot(p));
  }
  const Vec3 base = plane.project(points.front());
  const auto at = [&](double t) { return Vec3(base + (t - along.dot(base)) * along); };
  return {at(low - 0.25 * edge), at(high + 0.25 * edge)};
}

/// Mean square of how far a part's points may lie from it, m².
double squared_tolerance(const Part& part, const VoxelGrid& grid, const Cells& cells) {
  double sum = 0, count = 0;
  for (const int c : part.cells) {
    sum += grid.moments[c].count * cells.tolerance[c] * cells.tolerance[c];
    count += grid.moments[c].count;
  }
  return sum / count;
}

}  // namespace

std::vector<int> describe_planes(const Model& model, const std::vector<Moments>& sums, const VoxelGrid& grid, const Cells& cells,
                                 const Space& space, Arrangement& result, const Context& context) {
  // The largest planes first: ids are stable and lists start with what matters.
  std::vector<int> order;
  const auto on_plane = [&](std::size_t p) {  // the last refit may have carried a plane off its points
    const Plane plane = model.plane(model.parts[p]);
    return sums[p].squared_distances(plane.normal, plane.offset) < sums[p].count * squared_tolerance(model.parts[p], grid, cells);
  };
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (sums[p].count >= 3 && on_plane(p)) order.push_back(static_cast<int>(p));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return model.parts[a].cells.size() > model.parts[b].cells.size();
  });
  std::vector<int> renumber(model.parts.size(), -1);
  std::vector<int> result_frame(model.frames.size(), -1);
  std::map<std::pair<int, int>, int> direction_of;
  for (const int p : order) {
    const Surface& m = model.surfaces[model.parts[p].surface];
    renumber[p] = static_cast<int>(result.planes.size());
    ArrangedPlane plane;
    plane.plane = model.plane(model.parts[p]);
    auto [it, fresh] = direction_of.try_emplace({m.frame, m.local}, -1);
    if (fresh) {
      for (std::size_t d = 0; d < result.directions.size() && it->second < 0; ++d)
        if (line_angle(result.directions[d].normal, plane.plane.normal) < kSameDirection) it->second = static_cast<int>(d);
      int& frame = result_frame[m.frame];
      if (it->second < 0) {
        if (frame < 0) {
          frame = static_cast<int>(result.frames.size());
          result.frames.emplace_back();
        }
        it->second = static_cast<int>(result.directions.size());
        result.directions.push_back({plane.plane.normal, frame});
        result.frames[frame].directions.push_back(it->second);
      }
    }
    plane.direction = it->second;
    const Direction& direction = result.directions[plane.direction];
    plane.frame = direction.frame;
    if (plane.plane.normal.dot(direction.normal) < 0) plane.plane = {-plane.plane.normal, -plane.plane.offset};
    // Exactly the direction's numbers, up to sign, so that files say so too.
    plane.plane.normal = direction.normal;
    result.frames[plane.frame].planes.push_back(renumber[p]);
    result.planes.push_back(std::move(plane));
  }
  parallel_blocks(context, order.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Part& part = model.parts[order[i]];
      ArrangedPlane& plane = result.planes[i];
      std::vector<Vec3> points;
      for (const int c : part.cells) points.push_back(grid.moments[c].mean);
      if (space.is_2d()) {
        plane.segment = segment_of(points, plane.plane, space.flat_axis->cross(plane.plane.normal), grid.edge);
        for (Vec3& end : *plane.segment) end += (space.flat_at - space.flat_axis->dot(end)) * *space.flat_axis;
        plane.area = ((*plane.segment)[1] - (*plane.segment)[0]).norm();
        continue;
      }
      plane.polygon = outline(points, plane.plane, in_plane_axis(model, model.surfaces[part.surface]), grid.edge);
      plane.area = area_of(plane.polygon, plane.plane.normal);
    }
  });
  return renumber;
}

std::optional<int> flat_axis(const Arrangement& arrangement) {
  if (!arrangement.two_dimensional) return std::nullopt;
  const auto line = std::find_if(arrangement.planes.begin(), arrangement.planes.end(), [](const ArrangedPlane& p) { return p.segment.has_value(); });
  if (line == arrangement.planes.end()) return 2;
  const Vec3 across = line->plane.normal.cross((*line->segment)[1] - (*line->segment)[0]).cwiseAbs();
  int axis = 2;
  for (const int a : {1, 0})
    if (across[a] > across[axis]) axis = a;
  return axis;
}

std::array<int, 2> drawing_axes(const Arrangement& drawing) {
  const int flat = flat_axis(drawing).value_or(2);
  return {flat == 0 ? 1 : 0, flat == 2 ? 1 : 2};
}

void count_points(const Moments& points, const Space& space, ArrangedPlane& plane) {
  plane.points = static_cast<std::size_t>(points.count);
  plane.rms = points.count > 0
                  ? std::sqrt(points.squared_distances(plane.plane.normal, plane.plane.offset) / points.count)
                  : 0.0;
  if (points.count < 3) return;
  const PlaneFit fit = fit_plane(points, space);
  const double u = plane.plane.normal.dot(fit.u), v = space.is_2d() ? 0.0 : plane.plane.normal.dot(fit.v), off = std::hypot(u, v);
  plane.turned = line_angle(plane.plane.normal, fit.normal);
  const double error_u = std::sqrt(tilt_noise(points, fit, 0.0, fit.spread_u)), error_v = space.is_2d() ? 0.0 : std::sqrt(tilt_noise(points, fit, 0.0, fit.spread_v));
  const double error = off > 0 ? std::hypot(u * error_u, v * error_v) / off : std::max(error_u, error_v);
  plane.turned_error = error < kPi / 2 ? error : kPi / 2;  // of points in a line nothing is known
}

void find_relations(const AngleSet& angles, Arrangement& result) {
  constexpr double kHolds = 0.005 * kPi / 180.0;
  std::vector<std::size_t> planes_of(result.directions.size(), 0);
  for (const ArrangedPlane& p : result.planes) ++planes_of[p.direction];
  for (const std::size_t n : planes_of) result.plane_relations += n * (n - 1) / 2;
  for (std::size_t a = 0; a < result.directions.size(); ++a)
    for (std::size_t b = a + 1; b < result.directions.size(); ++b) {
      const double angle = line_angle(result.directions[a].normal, result.directions[b].normal);
      for (const double theta : angles.all) {
        const double folded = std::min(theta, kPi - theta);
        if (std::abs(angle - folded) > kHolds) continue;
        result.relations.push_back({static_cast<int>(a), static_cast<int>(b), folded});
        result.plane_relations += planes_of[a] * planes_of[b];
        break;
      }
    }
}

}  // namespace unseen::planes
