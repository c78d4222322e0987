// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "evaluate.h"
#include "unseen/core/error.h"
#include "unseen/io/mesh.h"
#include "unseen/io/points.h"
#include "unseen/planes/evaluate.h"
#include "unseen/report/planes_evaluation.h"
#include "unseen/report/planes_result.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluatePlanesArguments {
  std::string result, truth;
  CommonFlags common;
  GivenOptions given;
  std::optional<double> scale;
  int pairs = 500000;
  int seed = 1;
  double overlap = 0.8;
  std::string label_field;

  OptionTable table() {
    OptionTable table;
    table.add({"scale",
               &scale,
               "m",
               "how near the truth must be; without it, the scale of the result",
               1e-12,
               1e12,
               {}});
    table.add({"pairs", &pairs, "", "point pairs drawn for the angles", 1, 1e9, {}});
    table.add({"seed", &seed, "", "seed of the pairs", 0, 2147483647, {}});
    table.add({"overlap",
               &overlap,
               "1",
               "labels: share of each other that a pair of regions must cover",
               0.501,
               1,
               {}});
    table.add({"label_field",
               &label_field,
               "",
               "name of the truth's field that holds labels; without it, the usual ones",
               {},
               {},
               {}});
    return table;
  }
};

/// A result with the points it was made from.
struct Scored {
  planes::Arrangement arrangement;
  std::vector<Plane> planes;
  PointCloud points;  ///< labels: the plane of each point, −1 = none
};

std::vector<Plane> infinite_planes(const planes::Arrangement& arrangement) {
  std::vector<Plane> planes;
  for (const planes::ArrangedPlane& p : arrangement.planes) planes.push_back(p.plane);
  return planes;
}

Scored read_result(const fs::path& path) {
  const fs::path file = result_file(path);
  Scored scored;
  scored.arrangement = report::read_planes_result(file);
  scored.planes = infinite_planes(scored.arrangement);
  const fs::path points = file.parent_path() / "points.ply";
  scored.points = read_all(*io::open_points(points));
  if (scored.points.labels.size() != scored.points.size())
    throw InputError(points.string(), "plane", "no such property", "the plane of each point");
  for (const std::int32_t plane : scored.points.labels)
    if (plane < -1 || plane >= static_cast<std::int64_t>(scored.planes.size()))
      throw InputError(points.string(), "plane", std::to_string(plane), "a plane of result.json, or -1");
  return scored;
}

std::vector<int> planes_of(const PointCloud& points) {
  return {points.labels.begin(), points.labels.end()};
}

void check_same_points(const PointCloud& a, const PointCloud& b, const fs::path& truth) {
  if (a.size() != b.size())
    throw InputError(truth.string(), "points", std::to_string(b.size()),
                     fmt::format("{}, as in the result", a.size()));
}

bool is_result(const fs::path& path) {
  return fs::is_directory(path) || path.extension() == ".json";
}

bool may_be_mesh(const fs::path& path) {
  for (const char* ending : {".obj", ".off", ".stl", ".ply", ".OBJ", ".OFF", ".STL", ".PLY"})
    if (path.extension() == ending) return true;
  return false;
}

/// Compares with what the truth turns out to be: another result, a mesh, or a cloud with labels.
void compare(const Scored& scored, const EvaluatePlanesArguments& args, report::PlanesEvaluation& e, Context& context) {
  const planes::EvaluateOptions options = {e.scale, static_cast<std::size_t>(args.pairs),
                                           static_cast<std::uint64_t>(args.seed)};
  const std::vector<int> plane_of_point = planes_of(scored.points);
  if (is_result(args.truth)) {
    const Scored truth = read_result(args.truth);
    check_same_points(scored.points, truth.points, args.truth);
    e.truth_kind = "result";
    e.truth = planes::evaluate_against_result(scored.points.positions, plane_of_point, scored.planes,
                                              planes_of(truth.points), truth.planes, options, context);
    return;
  }
  const TriangleMesh mesh = may_be_mesh(args.truth) ? io::read_mesh(args.truth) : TriangleMesh{};
  if (!mesh.triangles.empty()) {
    e.truth_kind = "mesh";
    e.truth = planes::evaluate_against_mesh(scored.points.positions, plane_of_point, scored.planes, mesh,
                                            options, context);
    return;
  }
  io::ReadOptions read;
  read.label_field = args.label_field;
  const PointCloud truth = read_all(*io::open_points(args.truth, read));
  if (truth.labels.size() != truth.size())
    throw InputError(args.truth, "labels", "none",
                     "a mesh, a result, or a cloud with a label for each point");
  check_same_points(scored.points, truth, args.truth);
  e.truth_kind = "labels";
  e.labels = planes::evaluate_against_labels(plane_of_point, planes_of(truth), args.overlap);
}

int run(EvaluatePlanesArguments& args) {
  OptionTable table = args.table();
  if (resolve_or_dump(table, args.common, "evaluate", args.given)) return kSolved;
  require(args.result, "OUT");
  require(args.truth, "--truth TRUTH");

  Session session(args.common);
  Context& context = session.context;

  const Scored scored = read_result(args.result);
  report::PlanesEvaluation e;
  e.result_path = args.result;
  e.truth_path = args.truth;
  e.scale = args.scale.value_or(scored.arrangement.scale);
  e.relations = planes::evaluate_relations(scored.arrangement);
  Summary summary;
  {
    const Stage stage(context, summary, "evaluate");
    compare(scored, args, e, context);
  }
  publish(e, result_file(args.result).parent_path(), args.common, session);
  return kSolved;
}

}  // namespace

Command add_evaluate_planes(CLI::App& evaluate) {
  auto args = std::make_shared<EvaluatePlanesArguments>();
  CLI::App* sub = evaluate.add_subcommand(
      "planes", "Measure a result of unseen planes, and write evaluation.json into it");
  sub->add_option("OUT", args->result, "the folder that unseen planes wrote");
  sub->add_option("--truth", args->truth,
                  "a mesh, another result for the same points, or the points with labels")
      ->type_name("TRUTH");
  add_flags(*sub, args->table(), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen evaluate planes OUT --truth house.obj\n"
      "  unseen evaluate planes OUT --truth labelled.pcd");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
