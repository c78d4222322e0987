// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/collision_shot_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {

constexpr std::size_t kLargestSightings = std::size_t{64} << 20, kLastFrame = 10'000'000;
constexpr double kFarthestPixel = 1e5;
constexpr double kOutside = 0.5;  // of the picture's size, that a centre may lie beyond its edge

std::vector<collision::Sighting> read_sightings(const std::filesystem::path& path, const std::vector<collision::Body>& bodies, const Camera& camera) {
  const std::string expected = "a list of sightings: [{\"frame\", \"x\", \"y\", \"radius\", \"label\"}, …]";
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestSightings), path.string(), expected);
  const JsonField json(parsed, path.string());
  const auto coordinate = [](const JsonField& field, int size) {
    return size > 0 ? field.number(-kOutside * size, (1.0 + kOutside) * size) : field.number(-kFarthestPixel, kFarthestPixel);
  };
  std::vector<collision::Sighting> sightings;
  std::map<std::pair<int, int>, Vec2> seen;  // by body and frame
  for (const JsonField& field : json.list()) {
    field.allow_only({"frame", "x", "y", "radius", "label"});
    collision::Sighting s;
    s.frame = field["frame"].index(kLastFrame);
    s.pixel = {coordinate(field["x"], camera.width), coordinate(field["y"], camera.height)};
    if (field.has("radius")) s.radius = field["radius"].number(1e-3, kFarthestPixel);
    if (field.has("label")) {
      s.body = free_body(field["label"], bodies);
      if (seen.try_emplace({s.body, s.frame}, s.pixel).first->second != s.pixel)
        field["label"].fail(fmt::format("no second place of it in frame {}", s.frame));
    }
    sightings.push_back(s);
  }
  if (sightings.empty()) throw InputError(path.string(), "", "no sightings", expected);
  std::stable_sort(sightings.begin(), sightings.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return sightings;
}

}  // namespace unseen::report
