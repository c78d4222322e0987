// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/planes.h"

#include <fmt/format.h>

#include <algorithm>

#include "planes/arrange.h"
#include "planes/patches/patches.h"
#include "planes/result/assign.h"
#include "planes/result/describe.h"
#include "planes/result/remarks.h"
#include "planes/scan/cells.h"
#include "planes/scan/dashes.h"
#include "planes/scan/scale.h"
#include "planes/selection/doubt.h"
#include "planes/selection/select.h"
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

/// What a first look at the source tells.
struct Look {
  Survey survey;
  Space space;
  Scale scale;
  double raster = 0;         ///< m, of the coordinates
  double pixel = 0;          ///< m, of a drawing in pixels
  bool use_normals = false;  ///< those of the input
};

Look look_at(PointSource& source, const Options& options, Context& context, Arrangement& result) {
  const Stage stage(context, result.summary, "survey");
  const SourceInfo info = source.info();
  const bool estimated = !options.scale && !options.relative_scale;
  Look look;
  look.survey = survey(source, context);
  check_distinct(look.survey, info.name);
  look.space = space_of(look.survey, info.two_dimensional);
  look.raster = rounding_of(look.survey);
  look.pixel = pixel_of(look.survey, look.space, look.raster);
  look.scale = choose_scale(source, look.survey, look.space, options, context, look.pixel);
  look.use_normals = normals_usable(look.survey, look.space, context);
  result.scale = look.scale.scale;
  result.two_dimensional = look.space.is_2d();
  if (info.has_normals && !look.use_normals) context.warn("input normals are not usable; they are estimated instead");
  if (look.space.is_2d() && !info.two_dimensional) {
    const double thick = look.space.flat_axis->dot(look.survey.high - look.survey.low);
    if (thick > 0.0) context.warn(fmt::format("the points are a slice, {:.3g} m thick: taken as a drawing", thick));
    else context.message("all points share one coordinate: taken as a drawing");
  }
  if (estimated)
    context.message(fmt::format("scale {:.4g}{unit}, {}; points may lie {:.4g}{unit} from their plane", result.scale, look.scale.step > 0.0 ? "as the steps of the depth ask for" : "estimated from spacing and noise",
                                look.scale.tolerance, fmt::arg("unit", look.space.is_2d() ? "" : " m")));
  warn_of_rounding(look.survey, result.scale, context);
  if (estimated) warn_of_units(look.survey, look.space, result.scale, context);
  result.summary.counts = {{"points", look.survey.points}, {"assigned", 0}, {"patches", 0}, {"planes", 0}, {"finite", look.survey.finite}, {"duplicates", look.survey.duplicates}};
  return look;
}

void arrange(PointSource& source, const Options& options, Context& context, const AssignmentSink& sink,
             Arrangement& result) {
  Summary& summary = result.summary;
  if (options.scale && options.relative_scale) throw InputError("", "relative_scale", "given with scale", "one of the two");
  const AngleSet angles = angles_of(options);
  const std::optional<Vec3> viewpoint = viewpoint_of(options, source.info());
  for (const double a : options.angles) result.angles.push_back(radians(a));
  result.lambda = options.lambda;

  const Look look = look_at(source, options, context, result);
  const Survey& seen = look.survey;
  const Space& space = look.space;
  const double tolerance = look.scale.tolerance;
  VoxelGrid grid;
  {
    Stage stage(context, summary, "voxels");
    const VoxelBuilder voxels = summarise(source, 0.5 * result.scale, seen.within, seen.duplicate, context);
    if (voxels.outside() > 0)
      context.warn(fmt::format("{} of {} points lie far from all others and are left out", voxels.outside(), seen.finite));
    grid = VoxelGrid(voxels, context);
    grid.tolerance = tolerance;
    grid.raster = look.raster;
    grid.pixel = look.pixel;
    grid.rounding = std::max(look.raster, look.scale.step);
    check_not_collinear(grid, space, source.info().name);
    if (!look.use_normals) grid.normals.clear();
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
    join_parts(model, grid, cells, context);
  }
  std::vector<Moments> sums(model.parts.size());
  Reach reach;
  {
    Stage stage(context, summary, "refit");
    reach = find_reach(model, grid, cells, look.use_normals, context);
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
    for (std::size_t s = 0; s < on_surface.size(); ++s) update_support(model.surfaces[s], on_surface[s], space, patches.least_noise);
    keep_main_sheets(model, seen, grid, space, 2.0 * patches.least_noise, tolerance, context);
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
      if (index_of[p] >= 0) count_points(points.moments(p), space, result.planes[index_of[p]]);
    for (const ArrangedPlane& p : result.planes) summary.counts[1].second += p.points;
    summary.counts[3].second = result.planes.size();
    warn_of_few(source, seen, space, !options.scale && !options.relative_scale, result, context);
  }
  Stage stage(context, summary, "relations");
  find_relations(angles, result);
  find_second_order(result, look.raster);
  tag_planes(result);
  warn_of_up(result, context);
  warn_of_curves(patches, space, context);
  warn_of_right_angles(result, angles, context);
  if (model.certain == kCertain) warn_of_turned(result, context);
  context.check();
  summary.counts.emplace_back("frames", result.frames.size());
  summary.counts.emplace_back("relations", result.relations.size());
  if (result.planes.empty()) summary.status = Status::infeasible;
}

}  // namespace

Arrangement find_planes(PointSource& source, const Options& options, Context& context, const AssignmentSink& sink) {
  check_options(options);
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
