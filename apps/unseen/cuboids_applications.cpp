// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids_applications.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "unseen/core/error.h"
#include "unseen/io/mesh.h"
#include "unseen/io/points.h"
#include "unseen/io/write_png.h"
#include "unseen/io/write_points.h"
#include "unseen/report/cuboids_applications.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSamples = 50'000;        // on a mesh
constexpr double kFullest = 0.95;               // what must be full to the last voxel is in no scan
constexpr std::uintmax_t kLargestEdits = 1'000'000;  // bytes

/// A model as its file has it, and points of its surface.
struct Model {
  std::string name;
  TriangleMesh mesh;  ///< without triangles for a cloud
  PointCloud points;
};

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Model read_model(const fs::path& path) {
  Model model{path.filename().string(), {}, {}};
  const std::string ending = ending_of(path);
  const bool mesh_only = ending == ".obj" || ending == ".off" || ending == ".stl";
  if (mesh_only || ending == ".ply") model.mesh = io::read_mesh(path);
  if (!model.mesh.triangles.empty()) {
    model.points = io::sample_mesh(model.mesh, kSamples, 1);
  } else if (mesh_only) {
    model.points.positions = model.mesh.vertices;
  } else {
    model.points = read_all(*io::open_points(path));
  }
  return model;
}

/// What `body` gives; where it throws of `source`, since the library knows no files, of the file instead.
template <class Body>
auto naming(const std::string& file, const std::string& source, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw InputError(error.source == source ? file : error.source, error.field, error.found, error.expected);
  }
}

std::string complete(const std::string& path, const RgbdFrame& frame, const cuboids::Options& method, const cuboids::Completion& scene,
                     const io::OutputFolder& out, Context& context) {
  const Model model = read_model(path);
  cuboids::ScanCompletionOptions options;
  options.fill = std::min(method.fill, kFullest);
  options.noise = method.noise.value_or(options.noise);
  const cuboids::ScanCompletion found = naming(path, "model", [&] { return cuboids::complete_scan(frame, scene, model.points, options, context); });
  write_text(out.file("completed.json"), report::scan_completion_json(found, model.name));
  if (!found.found) {
    context.warn(fmt::format("no object of the scene is like {}: no completed.ply", model.name));
    return fmt::format("completed by {}: nothing like it", model.name);
  }
  CloudSource cloud(found.completed);
  io::write_points(out.file("completed.ply"), cloud, context);
  return fmt::format("completed by {}: completed.ply, {:.0f} % of the points seen lie on the model", model.name, 100.0 * found.explained);
}

/// The usable models of a folder by the order of their names; what cannot be read is a warning.
std::vector<Model> read_models(const fs::path& folder, Context& context) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "", "no folder", "a folder of models");
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    for (const char* ending : {".ply", ".obj", ".off", ".stl", ".pcd", ".xyz"})
      if (entry.is_regular_file() && ending_of(entry.path()) == ending) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Model> models;
  for (const fs::path& path : paths) {
    context.check();
    try {
      models.push_back(read_model(path));
    } catch (const InputError& error) {
      context.warn(fmt::format("left out: {}", error.what()));
    }
  }
  if (models.empty()) throw InputError(folder.string(), "models", "none that can be read", "PLY, OBJ, OFF, STL, PCD or XYZ files");
  return models;
}

std::string retrieve(const ApplicationFlags& flags, const cuboids::Options& method, const cuboids::Completion& scene, const io::OutputFolder& out,
                     Context& context) {
  const std::vector<Model> models = read_models(flags.retrieve, context);
  std::vector<cuboids::RetrievalModel> candidates;
  for (const Model& model : models) candidates.push_back({model.name, model.points.positions});
  cuboids::RetrievalOptions options;
  options.ids = flags.object;
  options.seed = static_cast<std::uint64_t>(method.seed);
  const cuboids::Retrieval found = cuboids::retrieve_models(scene, candidates, options, context);
  write_text(out.file("retrieved.json"), report::retrieval_json(found, candidates));
  const cuboids::RetrievedModel& best = found.ranked.front();
  Model model = models[static_cast<std::size_t>(best.model)];
  for (auto* points : {&model.mesh.vertices, &model.points.positions})
    for (Vec3& p : *points) p = best.T_world_model * (best.scale * p);
  std::string said = fmt::format("best of {} model{}: {} (retrieved.ply; all ranked in retrieved.json)", models.size(), models.size() == 1 ? "" : "s", model.name);
  if (!model.mesh.triangles.empty()) {
    write_text(out.file("retrieved.ply"), report::mesh_ply(model.mesh));
    return said;
  }
  for (Vec3f& n : model.points.normals) n = best.T_world_model.rotation.cast<float>() * n;
  CloudSource cloud(model.points);
  io::write_points(out.file("retrieved.ply"), cloud, context);
  return said;
}

std::string edit(const std::string& path, const RgbdFrame& frame, const cuboids::Options& method, const cuboids::Completion& scene,
                 const io::OutputFolder& out, Context& context) {
  const auto edits = report::parse_photo_edits(read_text(path, kLargestEdits), path);
  cuboids::PhotoEditOptions options;
  options.noise = method.noise.value_or(options.noise);
  options.seed = static_cast<std::uint64_t>(method.seed);
  const cuboids::EditedPhoto edited = naming(path, "edits", [&] { return cuboids::edit_photo(frame, scene, edits, options, context); });
  io::write_color_png(out.file("edited.png"), edited.width, edited.height, edited.pixels);
  return "photograph edited: edited.png";
}

}  // namespace

void add_flags(CLI::App& app, ApplicationFlags& flags) {
  app.add_option("--complete", flags.complete, "complete the scan by this good scan of the same kind of object (upright, metres): completed.ply")
      ->type_name("MODEL");
  app.add_option("--retrieve", flags.retrieve, "rank the models of this folder (upright) by how well they fit: retrieved.json, retrieved.ply")
      ->type_name("DIR");
  app.add_option("--object", flags.object, "ids of the cuboids that --retrieve finds a model for (default: the largest object)")
      ->delimiter(',')
      ->type_name("ID,ID,..");
  app.add_option("--edit", flags.edit, "move or remove objects in the photograph: edited.png")->type_name("EDITS.json");
}

std::vector<std::string> run_applications(const ApplicationFlags& flags, const RgbdFrame& frame, const cuboids::Options& method,
                                          const cuboids::Completion& scene, io::OutputFolder& out, Context& context) {
  std::vector<std::string> said;
  if (!flags.complete.empty()) said.push_back(complete(flags.complete, frame, method, scene, out, context));
  if (!flags.retrieve.empty()) said.push_back(retrieve(flags, method, scene, out, context));
  if (!flags.edit.empty()) said.push_back(edit(flags.edit, frame, method, scene, out, context));
  return said;
}

}  // namespace unseen::cli
