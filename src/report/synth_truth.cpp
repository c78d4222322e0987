// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/synth_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "report/json_write.h"

namespace unseen::report {

std::string synth_truth_json(const planes::SynthScene& scene, const OptionTable& options) {
  Json json = made_by("synth planes", options);
  json["dimensions"] = scene.two_dimensional ? 2 : 3;
  json["points"] = scene.cloud.size();
  json["planes"] = Json::array();
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const bool turned = std::count(scene.turned.begin(), scene.turned.end(), static_cast<int>(i)) > 0;
    json["planes"].push_back({{"id", i},
                              {"normal", vector_of(scene.planes[i].normal)},
                              {"offset", number(scene.planes[i].offset)},
                              {"frame", scene.frames[i]},
                              {"turned", turned}});
  }
  json["frames"] = Json::array();
  for (std::size_t f = 0; f < scene.axes.size(); ++f) {
    Json axes = Json::array();
    for (int k = 0; k < 3; ++k) axes.push_back(vector_of(scene.axes[f].col(k)));
    json["frames"].push_back({{"id", f}, {"axes", axes}});
  }
  json["scanners"] = Json::array();
  for (const Vec3& scanner : scene.scanners) json["scanners"].push_back(vector_of(scanner));
  return text_of(json);
}

std::string labelled_obj(const TriangleMesh& mesh) {
  std::string text = "# true surfaces, a group for each label\n";
  auto out = std::back_inserter(text);
  for (const Vec3& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x(), v.y(), v.z());
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto label = [&](std::size_t t) { return mesh.labels.empty() ? 0 : mesh.labels[t]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return label(a) < label(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || label(order[i]) != label(order[i - 1]))
      fmt::format_to(out, "g plane_{}\n", label(order[i]));
    const auto& t = mesh.triangles[order[i]];
    fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return text;
}

}  // namespace unseen::report
