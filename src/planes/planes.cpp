// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/arrange.h"
#include "planes/assign.h"
#include "planes/cells.h"
#include "planes/describe.h"
#include "planes/doubt.h"
#include "planes/patches.h"
#include "planes/scale.h"
#include "planes/select.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

AngleSet angles_of(const Options& options) {
  std::vector<double> generators;
  for (const double a : options.angles) generators.push_back(radians(a));
  return make_angles(generators);
}

std::optional<Vec3> viewpoint_of(const Options& options, const SourceInfo& info) {
  if (options.viewpoint.empty()) return info.viewpoint;
  if (options.viewpoint.size() != 3)
    throw InputError("", "viewpoint", fmt::format("{} numbers", options.viewpoint.size()), "three: x,y,z");
  return Vec3(options.viewpoint[0], options.viewpoint[1], options.viewpoint[2]);
}

void check_distinct(const Survey& survey, const std::string& name) {
  const std::size_t distinct = survey.low == survey.high ? 1 : survey.finite - survey.duplicates;
  if (distinct < 3)
    throw InputError(name, "points", fmt::format("{} distinct", distinct), "at least three that are not in a line");
}

/// A line of points lies in infinitely many planes: there is no right answer.
void check_not_collinear(const VoxelGrid& grid, const Space& space, const std::string& name) {
  Moments all;
  for (const Moments& m : grid.moments) all += m;
  const PlaneFit fit = fit_plane(all, space);
  if (!space.is_2d() && fit.spread_v < 1e-6 * fit.spread_u)
    throw InputError(name, "points", "all in one line", "points on surfaces");
}

/// Warns of coordinates that single precision has rounded coarsely, as large ones are that were stored without an offset; false if it has not.
bool warn_of_single_precision(const Survey& survey, double scale, Context& context) {
  constexpr double kCoarse = 0.25;  // of the scale
  const auto farthest = static_cast<float>(std::max(survey.low.cwiseAbs().maxCoeff(), survey.high.cwiseAbs().maxCoeff()));
  const double step = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  const auto single = [](const Vec3& p) { return p == p.cast<float>().cast<double>(); };
  if (step < kCoarse * scale || !std::all_of(survey.sample.begin(), survey.sample.end(), single)) return false;
  context.warn(fmt::format("the coordinates, up to {:.7g} m, are rounded to single precision, in steps of {:.2g} m: details below that are lost. "
                           "Export them in double precision, or less an offset", farthest, step));
  return true;
}

/// Warns of text with so few digits that they end far before the details, as "5.6789e+06" does.
void warn_of_few_digits(const Survey& survey, double scale, Context& context) {
  constexpr double kCoarse = 0.25;          // of the scale
  constexpr double kFewSteps = 100, kFar = 1e4;  // of the extent, and of the coordinates: a grid of points has more of these, or is nearer to the origin
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = survey.high[axis] - survey.low[axis], farthest = std::max(std::abs(survey.low[axis]), std::abs(survey.high[axis]));
    const auto comes_in = [&](double step) {
      return farthest > kFar * step && std::all_of(survey.sample.begin(), survey.sample.end(), [&](const Vec3& p) { return std::abs(p[axis] / step - std::round(p[axis] / step)) < 1e-6; });
    };
    double step = std::pow(10.0, std::ceil(std::log10(std::max(kCoarse * scale, extent / kFewSteps))));
    if (!(extent > 0.0) || !comes_in(step)) continue;
    while (comes_in(10.0 * step)) step *= 10.0;
    context.warn(fmt::format("{} comes in steps of {:.4g} m only: digits were lost when it was written. Export more of them, in binary, or less an offset", "xyz"[axis], step));
  }
}

/// Warns where an estimated scale leaves most of the points without a plane, or a given one many because they are farther apart.
void warn_of_few(PointSource& source, const Survey& seen, const Space& space, bool estimated, const Arrangement& result, Context& context) {
  constexpr double kFew = 0.5, kMany = 0.1, kLarger = 1.5;
  std::size_t assigned = 0;
  for (const ArrangedPlane& p : result.planes) assigned += p.points;
  const double share = static_cast<double>(assigned) / static_cast<double>(seen.finite);
  if (result.planes.empty() || share > (estimated ? kFew : 1.0 - kMany)) return;
  if (estimated) {
    context.warn(fmt::format("only {:.0f} % of the points lie on planes at the estimated scale of {:.3g} m: plants do not; if the scene is made of planes, another "
                             "scale suits it better (--scale)", 100.0 * share, result.scale));
  } else if (const double scale = estimate_scale(source, seen, space, context).scale; scale > kLarger * result.scale) {
    context.warn(fmt::format("{:.0f} % of the points lie on no plane at a scale of {:.3g} m: their spacing and noise ask for {:.3g} m", 100.0 * (1.0 - share),
                             result.scale, scale));
  }
}

/// Warns where planes are at right angles that the angles asked for do not name.
void warn_of_right_angles(const Arrangement& result, const AngleSet& angles, Context& context) {
  constexpr double kRight = 0.5 * kPi / 180.0, kMany = 0.1;  // of all pairs of area: a third are in a box
  if (angles.has_right_angle) return;
  std::vector<double> area(result.directions.size(), 0.0);
  for (const ArrangedPlane& p : result.planes) area[p.direction] += p.area;
  double right = 0, all = 0;
  for (std::size_t a = 0; a < area.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      all += area[a] * area[b];
      if (line_angle(result.directions[a].normal, result.directions[b].normal) > kPi / 2 - kRight) right += area[a] * area[b];
    }
  if (right > kMany * all) context.warn("planes at right angles are not related, as the angles asked for do not name 90: add it, as in --angles 60,90");
}

void record(const Selection& selection, Summary& summary) {
  const Energy &before = selection.before, &after = selection.after;
  summary.energy = {{"before", before.total()},   {"after", after.total()},
                    {"data", after.data},         {"irregularity", after.irregularity},
                    {"smoothness", after.smoothness}, {"bound", selection.bound},
                    {"gap", after.total() - selection.bound}};
  if (selection.time_limit) summary.status = Status::time_limit;
}

/// One pass over the source with the plane of each point.
template <class Body>
void with_planes_of_points(PointSource& source, const Reach& reach, const VoxelGrid& grid, bool only_sure,
                           const Survey& survey, const Context& context, Body body) {
  std::vector<int> plane_of_point;
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    plane_of_point.resize(block.size());
    assign_points(reach, grid, block, only_sure, plane_of_point, context);
    body(block, first, plane_of_point);
    context.progress(std::min(1.0, static_cast<double>(first + block.size()) / static_cast<double>(survey.points)));
  });
}

void arrange(PointSource& source, const Options& options, Context& context, const AssignmentSink& sink,
             Arrangement& result) {
  Summary& summary = result.summary;
  const SourceInfo info = source.info();
  const AngleSet angles = angles_of(options);
  const std::optional<Vec3> viewpoint = viewpoint_of(options, info);
  for (const double a : options.angles) result.angles.push_back(radians(a));
  result.lambda = options.lambda;

  Survey seen;
  Space space;
  bool use_normals = false;
  double tolerance = 0, rounding = 0, levels = 0;
  {
    Stage stage(context, summary, "survey");
    seen = survey(source, context);
    check_distinct(seen, info.name);
    space = space_of(seen, info.two_dimensional);
    const Scale scale = choose_scale(source, seen, space, options, context);
    result.scale = scale.scale;
    tolerance = scale.tolerance;
    levels = scale.step;
    rounding = rounding_of(seen);
    use_normals = normals_usable(seen, space, context);
    result.two_dimensional = space.is_2d();
    if (info.has_normals && !use_normals) context.warn("input normals are not usable; they are estimated instead");
    if (space.is_2d() && !info.two_dimensional) context.message("all points share one coordinate: taken as a drawing");
    if (!options.scale && !options.relative_scale)
      context.message(fmt::format("scale {:.4g} m, estimated from spacing and noise; points may lie {:.4g} m from their plane", result.scale, tolerance));
    if (!warn_of_single_precision(seen, result.scale, context)) warn_of_few_digits(seen, result.scale, context);
    summary.counts = {{"points", seen.points}, {"assigned", 0}, {"patches", 0}, {"planes", 0},
                      {"finite", seen.finite}, {"duplicates", seen.duplicates}};
  }
  VoxelGrid grid;
  {
    Stage stage(context, summary, "voxels");
    const VoxelBuilder voxels = summarise(source, 0.5 * result.scale, seen.within, seen.duplicate, context);
    if (voxels.outside() > 0)
      context.warn(fmt::format("{} of {} points lie far from all others and are left out", voxels.outside(), seen.finite));
    grid = VoxelGrid(voxels, context);
    grid.tolerance = tolerance;
    grid.rounding = std::max(rounding, levels);
    check_not_collinear(grid, space, info.name);
    if (!use_normals) grid.normals.clear();
    summary.counts.emplace_back("voxels", grid.size());
  }
  Cells cells;
  {
    Stage stage(context, summary, "normals");
    cells = estimate_normals(grid, space, context);
    if (options.adaptive_scale) adapt_tolerance(cells, grid, viewpoint);
  }
  Patches patches;
  {
    Stage stage(context, summary, "patches");
    patches = segment(grid, cells, space, radians(options.patch_angle), context);
    summary.counts[2].second = patches.patches.size();
  }
  Model model;
  {
    Stage stage(context, summary, "selection");
    const Selection selection = select_as_built(patches, angles, space, options, context);
    record(selection, summary);
    if (selection.time_limit) context.warn("the exact solver ran out of time: the best selection found is not proven");
    model = build_model(selection, patches, grid, cells, angles, space, context);
    refit_held(model, tolerance, space);
    extend_parts(model, grid, cells, context);
  }
  std::vector<Moments> sums(model.parts.size());
  Reach reach;
  {
    Stage stage(context, summary, "refit");
    reach = find_reach(model, grid, cells, use_normals, context);
    PlaneSums points(model, result.scale);
    with_planes_of_points(source, reach, grid, true, seen, context, [&](const PointCloud& block, std::size_t first, std::vector<int>& plane) {
      drop_doubtful(reach, grid, block, plane, context);
      points.add(block, plane, seen.duplicate, first);
    });
    std::vector<Moments> on_surface(model.surfaces.size());
    for (std::size_t p = 0; p < sums.size(); ++p) {
      sums[p] = points.moments(p);
      on_surface[model.parts[p].surface] += sums[p];
    }
    for (std::size_t s = 0; s < on_surface.size(); ++s) update_support(model.surfaces[s], on_surface[s], space);
    refit_held(model, tolerance, space);
    if (relate_again(model, angles, space)) refit_held(model, tolerance, space);
    update_planes(reach, model);
  }
  {
    Stage stage(context, summary, "assignment");
    const std::vector<int> index_of = describe_planes(model, sums, grid, cells, space, result, context);
    PlaneSums points(model, result.scale);
    with_planes_of_points(source, reach, grid, false, seen, context, [&](const PointCloud& block, std::size_t, std::vector<int>& plane) {
      points.add(block, plane, {});
      for (int& p : plane) p = p < 0 ? -1 : index_of[p];
      if (sink) sink(block.positions, plane);
    });
    for (std::size_t p = 0; p < sums.size(); ++p)
      if (index_of[p] >= 0) count_points(points.moments(p), result.planes[index_of[p]]);
    for (const ArrangedPlane& p : result.planes) summary.counts[1].second += p.points;
    summary.counts[3].second = result.planes.size();
    warn_of_few(source, seen, space, !options.scale && !options.relative_scale, result, context);
  }
  Stage stage(context, summary, "relations");
  find_relations(angles, result);
  find_second_order(result);
  tag_planes(result);
  warn_of_right_angles(result, angles, context);
  context.check();
  summary.counts.emplace_back("frames", result.frames.size());
  summary.counts.emplace_back("relations", result.relations.size());
  if (result.planes.empty()) summary.status = Status::infeasible;
}

}  // namespace

Arrangement find_planes(PointSource& source, const Options& options, Context& context, const AssignmentSink& sink) {
  Arrangement result;
  try {
    arrange(source, options, context, sink, result);
  } catch (const Cancelled&) {
    Summary summary = std::move(result.summary);
    result = Arrangement();
    result.summary = std::move(summary);
    result.summary.status = Status::cancelled;
  }
  result.summary.warnings = context.take_warnings();
  return result;
}

}  // namespace unseen::planes
