// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "bench/planes_cases.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "unseen/core/error.h"
#include "unseen/io/mesh.h"

namespace unseen::bench {
namespace {

Case parse(const std::string& line, const std::string& source, const std::filesystem::path& data) {
  std::istringstream words(line);
  Case c;
  std::string word;
  words >> c.name;
  OptionTable synth;
  while (words >> word) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) throw InputError(source, "entry", word, "key=value");
    const std::string key = word.substr(0, equals), value = word.substr(equals + 1);
    if (key == "file")
      c.file = data / value;
    else if (key == "truth")
      c.truth = data / value;
    else if (key == "scale")
      c.scale = std::stod(value);
    else if (key == "angles")
      c.angles = {std::stod(value)};
    else if (key == "label_field")
      c.read.label_field = value, c.labels = true;
    else if (key == "frame_step")
      c.read.frame_step = std::stoi(value);
    else if (key == "depth_step")
      c.read.depth_step = std::stoi(value);
    else {
      if (!c.synth) {
        c.synth.emplace();
        synth = planes::describe(*c.synth);
      }
      synth.set_text(key == "synth" ? "scene" : key, value, source);
    }
  }
  if (!(c.scale > 0)) throw InputError(source, "scale", fmt::format("{}", c.scale), "a length above 0");
  if (c.file.empty() == !c.synth) throw InputError(source, "file", c.file.string(), "either file= or synth=");
  return c;
}

}  // namespace

std::vector<Case> read_cases(const std::filesystem::path& list, const std::filesystem::path& data) {
  std::ifstream in(list);
  if (!in) throw InputError(list.string(), "file", "nothing", "a list of cases");
  std::vector<Case> cases;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    cases.push_back(parse(line, fmt::format("{}:{}", list.string(), number), data));
  }
  return cases;
}

Loaded load(const Case& c) {
  Loaded loaded;
  if (c.synth) {
    Context context;
    loaded.scene = planes::make_scene(*c.synth, context);
    loaded.cloud = std::move(loaded.scene->cloud);
    loaded.truth = std::move(loaded.scene->truth);
    return loaded;
  }
  const auto source = io::open_points(c.file, c.read);
  PointCloud all = read_all(*source);
  for (std::size_t i = 0; i < all.size(); ++i) {  // peers do not take what is not finite
    if (!all.positions[i].allFinite()) continue;
    loaded.cloud.positions.push_back(all.positions[i]);
    if (!all.normals.empty()) loaded.cloud.normals.push_back(all.normals[i]);
    if (!all.labels.empty()) loaded.cloud.labels.push_back(all.labels[i]);
  }
  loaded.cloud.viewpoint = all.viewpoint;
  if (!c.truth.empty()) loaded.truth = io::read_mesh(c.truth);
  return loaded;
}

}  // namespace unseen::bench
