// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/interactions_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "report/interactions_structures.h"
#include "unseen/report/interactions_result.h"

namespace unseen::report {
namespace {

using namespace interactions;

double seconds_of(const Reconstruction& r, int frame) {
  return frame / r.fps;
}

/// "2.4–5.1, 7.0–8.2", in seconds; windows that follow each other are one stretch.
std::string spans_of(const Reconstruction& r, const std::vector<int>& windows) {
  std::vector<std::array<int, 2>> spans;  // of frames
  for (const int w : windows) spans.push_back({r.windows[static_cast<std::size_t>(w)].first, r.windows[static_cast<std::size_t>(w)].last});
  std::sort(spans.begin(), spans.end());
  std::vector<std::array<int, 2>> joined;
  for (const auto& span : spans) {
    if (!joined.empty() && span[0] <= joined.back()[1] + 1) joined.back()[1] = std::max(joined.back()[1], span[1]);
    else joined.push_back(span);
  }
  std::string text;
  for (const auto& [first, last] : joined) text += fmt::format("{}{:.1f}–{:.1f}", text.empty() ? "" : ", ", seconds_of(r, first), seconds_of(r, last));
  return text;
}

void add_object_table(SceneBuilder& scene, const Reconstruction& r) {
  Json rows = Json::array();
  for (const FoundObject& found : r.objects) {
    const OrientedBox box = upright_box(found.object);
    const Vec3 size = 2.0 * box.half_size;
    rows.push_back({found.object.category, number(found.confidence), fmt::format("{:.2f}, {:.2f}", box.center.x(), box.center.y()),
                    fmt::format("{:.2f} × {:.2f} × {:.2f}", size.x(), size.y(), size.z()), found.object.id, spans_of(r, found.windows)});
  }
  add_table(scene, "Objects",
            {column("category"), column("confidence", "", 2), column("place", "m"), column("size", "m"), column("id"), column("in use", "s")},
            std::move(rows), "objects");
}

double share_from_scenelets(const std::vector<PersonFrame>& frames) {
  const auto count = std::count_if(frames.begin(), frames.end(), [](const PersonFrame& f) { return f.source == PoseSource::scenelet; });
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, frames.size()));
}

/// On the ground, m.
double path_length(const std::vector<PersonFrame>& frames) {
  double sum = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) sum += (frames[i].pose.col(pelvis) - frames[i - 1].pose.col(pelvis)).head<2>().norm();
  return sum;
}

void add_people_table(SceneBuilder& scene, const Reconstruction& r) {
  Json rows = Json::array();
  for (const Person& p : r.people) {
    if (p.frames.empty())
      rows.push_back({name_of(p), nullptr, nullptr, 0, nullptr, nullptr});
    else
      rows.push_back({name_of(p), number(seconds_of(r, p.frames.front().frame)), number(seconds_of(r, p.frames.back().frame)), p.frames.size(),
                      number(100.0 * share_from_scenelets(p.frames)), number(path_length(p.frames))});
  }
  add_table(
      scene, "People",
      {column("name"), column("from", "s", 1), column("to", "s", 1), column("frames"), column("from scenelets", "%", 0), column("path", "m", 1)},
      std::move(rows), "people");
}

void add_window_table(SceneBuilder& scene, const Reconstruction& r) {
  Json rows = Json::array();
  for (const Window& w : r.windows)
    rows.push_back({number(seconds_of(r, w.first)), number(seconds_of(r, w.last)), w.person, number(w.likelihood), number(w.energy), w.scenelet});
  add_table(
      scene, "Windows",
      {column("from", "s", 1), column("to", "s", 1), column("person"), column("likelihood", "", 2), column("energy", "", 3), column("scenelet")},
      std::move(rows));
}

void add_facts(SceneBuilder& scene, const Reconstruction& r) {
  std::size_t frames = 0;
  double scenelets = 0, hidden = 0;
  for (const Person& p : r.people) {
    frames += p.frames.size();
    scenelets += share_from_scenelets(p.frames) * static_cast<double>(p.frames.size());
    for (const PersonFrame& f : p.frames) hidden += static_cast<double>((f.confidence < 0.5).count()) / kJoints;
  }
  add_fact(scene, "objects", std::to_string(r.objects.size()));
  add_fact(scene, "people", std::to_string(r.people.size()));
  add_fact(scene, "windows with an interaction", std::to_string(r.windows.size()), "Stretches of time in which somebody sits, lies, or uses something");
  if (frames > 0) {
    const double all = static_cast<double>(frames);
    add_fact(scene, "poses", std::to_string(frames));
    add_fact(scene, "poses from scenelets", fmt::format("{:.0f} %", 100.0 * scenelets / all), "Poses that were not seen well and come from recorded people who do alike");
    add_fact(scene, "joints hardly seen", fmt::format("{:.0f} %", 100.0 * hidden / all));
  }
  add_fact(scene, "camera height", fmt::format("{:.2f} m", r.ground.camera_height));
  add_fact(scene, "camera pitch", fmt::format("{:.1f}°", degrees(r.ground.pitch)));
  if (!r.ground.source.empty()) add_fact(scene, "ground from", r.ground.source);
}

/// The room, not the camera before it.
Json focus_of(const Eigen::AlignedBox3d& reach) {
  const Vec3 margin = Vec3::Constant(std::max(0.1, 0.03 * reach.sizes().maxCoeff()));
  return {{"low", vector_of(reach.min() - margin)}, {"high", vector_of(reach.max() + margin)}};
}

}  // namespace

std::string interactions_scene(const Reconstruction& r, const InputRecord& input, const OptionTable& options, const std::string& command,
                               const std::vector<Take>& takes, const std::string& evidence_png) {
  SceneBuilder scene(Vec3::Zero());
  Json& header = scene.header;
  header["title"] = interactions_title(input);
  write_run(scene, "interactions", command, r.summary, options, input);
  if (r.objects.empty()) header["verdict"] = "no furniture was found: nobody was seen to use any";
  header["inside"] = false;
  if (const Eigen::AlignedBox3d reach = reach_of(r); !reach.isEmpty()) header["focus"] = focus_of(reach);
  header["about"] =
      "Furniture as people use it: where somebody sits or leans, there is something to sit or lean on. Places are off by some 20 to 60 cm, kinds are a guess by what is "
      "done there, and confidence says whether there is something at all.";
  add_facts(scene, r);
  add_floor(scene, r);
  if (!evidence_png.empty()) add_evidence(scene, r.evidence, evidence_png, kEvidencePixels);
  add_objects(scene, r);
  add_people(scene, r);
  add_paths(scene, r);
  add_camera(scene, r);
  if (takes.size() == 1) add_detections(scene, r, takes.front());
  add_likelihood_chart(scene, r);
  add_object_table(scene, r);
  add_people_table(scene, r);
  add_window_table(scene, r);
  return scene.encode();
}

std::vector<std::string> takes_of(const InputRecord& input) {
  std::error_code none;  // a list of many is too long for a path
  if (std::filesystem::exists(input.path, none)) return {input.path};
  std::vector<std::string> paths;
  std::size_t begin = 0;
  for (std::size_t end; (end = input.path.find(kBetweenTakes, begin)) != std::string::npos; begin = end + kBetweenTakes.size())
    paths.push_back(input.path.substr(begin, end - begin));
  paths.push_back(input.path.substr(begin));
  return paths;
}

std::string interactions_title(const InputRecord& input) {
  std::string names;
  for (const std::string& take : takes_of(input)) {
    std::filesystem::path path(take);
    if (path.filename() == "take.json" && path.has_parent_path()) path = path.parent_path();
    const std::string name = path.filename().string();
    names += (names.empty() ? "" : ", ") + (name.empty() ? take : name);
  }
  return "Interactions of " + names;
}

}  // namespace unseen::report
