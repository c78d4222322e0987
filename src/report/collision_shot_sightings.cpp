// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "report/collision_shot_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {

constexpr std::size_t kLargestSightings = std::size_t{64} << 20, kLastFrame = 10'000'000;
constexpr double kFarthestPixel = 1e5;

std::vector<collision::Sighting> read_sightings(const std::filesystem::path& path, const std::vector<collision::Body>& bodies) {
  const std::string expected = "a list of sightings: [{\"frame\", \"x\", \"y\", \"radius\", \"label\"}, …]";
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestSightings), path.string(), expected);
  const JsonField json(parsed, path.string());
  std::vector<collision::Sighting> sightings;
  for (const JsonField& field : json.list()) {
    field.allow_only({"frame", "x", "y", "radius", "label"});
    collision::Sighting s;
    s.frame = field["frame"].index(kLastFrame);
    s.pixel = {field["x"].number(-kFarthestPixel, kFarthestPixel), field["y"].number(-kFarthestPixel, kFarthestPixel)};
    if (field.has("radius")) s.radius = field["radius"].number(1e-3, kFarthestPixel);
    if (field.has("label")) s.body = free_body(field["label"], bodies);
    sightings.push_back(s);
  }
  if (sightings.empty()) throw InputError(path.string(), "", "no sightings", expected);
  std::stable_sort(sightings.begin(), sightings.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return sightings;
}

}  // namespace unseen::report
