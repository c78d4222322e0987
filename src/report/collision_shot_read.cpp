// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/collision_shot_parts.h"
#include "unseen/core/error.h"
#include "unseen/report/collision_shot.h"

namespace unseen::report {
namespace {

using collision::Shape;
using collision::Shot;

constexpr std::size_t kLargestFile = std::size_t{8} << 20, kMostFrames = 10'000'000;
constexpr int kMostPixels = 100'000;
constexpr double kMostFps = 1e7, kMostGravity = 100.0;  // frames/s, m/s²
constexpr double kFarthest = 1e4;                       // m

/// Two bodies, what moves first.
std::vector<collision::Body> read_bodies(const JsonField& json, const std::filesystem::path& folder) {
  const auto fields = json.list();
  if (fields.size() != 2)
    json.fail("two bodies: two that move, or one that moves and {\"name\": \"floor\", \"fixed\": true} that it hits");
  std::vector<collision::Body> bodies;
  for (const JsonField& field : fields) bodies.push_back(read_body(field, folder));
  if (bodies[0].name == bodies[1].name) fields[1]["name"].fail("a name of its own");
  if (bodies[0].shape == Shape::fixed && bodies[1].shape == Shape::fixed) fields[1]["fixed"].fail("at most one body that is fixed");
  if (bodies[0].shape == Shape::fixed) std::swap(bodies[0], bodies[1]);
  return bodies;
}

std::array<int, 4> read_roi(const JsonField& json) {
  const auto values = json.list();
  if (values.size() != 4) json.fail("x, y, width and height in pixels");
  std::array<int, 4> roi = {};
  for (std::size_t i = 0; i < 4; ++i) roi[i] = values[i].index(kMostPixels);
  if (roi[2] < 1 || roi[3] < 1) json.fail("a width and a height above 0");
  return roi;
}

std::array<int, 2> read_frames(const JsonField& json) {
  const auto values = json.list();
  if (values.size() != 2) json.fail("the first and the last frame");
  const std::array<int, 2> frames = {values[0].index(kMostFrames), values[1].index(kMostFrames)};
  if (frames[0] >= frames[1]) json.fail("a last frame after the first");
  return frames;
}

Plane read_floor(const JsonField& json) {
  json.allow_only({"normal", "offset"});
  const double length = json["normal"].vector().norm();
  const Vec3 normal = read_direction(json["normal"]);  // n·p = d stays what it is when both sides are divided by |n|
  return {normal, json["offset"].number(-kFarthest, kFarthest) / length};
}

/// A quaternion as written in a file: rounded, and perhaps the other sign.
collision::Quat read_quaternion(const JsonField& json) {
  constexpr double kRounding = 0.01;
  const auto values = json.list();
  if (values.size() != 4) json.fail("four numbers, w first");
  const collision::Quat q(values[0].number(), values[1].number(), values[2].number(), values[3].number());
  if (!(std::abs(q.norm() - 1.0) < kRounding)) json.fail(fmt::format("a quaternion of length 1; its length is {:.4g}", q.norm()));
  return q.normalized();
}

collision::OrientationHint read_orientation(const JsonField& json, const Shot& shot) {
  json.allow_only({"body", "t", "frame", "q"});
  collision::OrientationHint hint;
  hint.body = free_body(json["body"], shot.bodies);
  if (json.has("t") == json.has("frame")) json.fail("either t (s) or frame");
  if (json.has("t")) {
    hint.time = json["t"].number(0, kMostFrames);
  } else {
    if (!shot.fps) json["frame"].fail("t (s), or \"fps\" in the shot, which tells the time of a frame");
    hint.time = json["frame"].number(0, kMostFrames) / *shot.fps;
  }
  hint.q = read_quaternion(json["q"]);
  return hint;
}

/// Either a video, or sightings and what a video would have told.
void read_footage(Shot& shot, const JsonField& json, const std::filesystem::path& folder) {
  if (json.has("fps")) shot.fps = json["fps"].number(0.1, kMostFps);
  if (json.has("video") == json.has("observations"))
    throw InputError(shot.name, "video", json.has("video") ? "\"observations\" beside it" : "nothing",
                     "the name of a video, or instead of it \"observations\", a file of sightings");
  if (json.has("video")) {
    shot.video = io::named_file(json, "video", folder).string();
    return;
  }
  shot.observations = read_sightings(io::named_file(json, "observations", folder), shot.bodies, shot.camera.camera);
  if (!shot.fps) throw InputError(shot.name, "fps", "nothing", "frames a second: without a video nothing else tells");
  const Camera& camera = shot.camera.camera;
  if (camera.fx <= 0 && camera.width <= 0)
    throw InputError(shot.name, "camera", "no size", "\"width\" and \"height\" beside \"hfov_deg\": without a video nothing else tells");
}

}  // namespace

collision::ShotCamera read_shot_camera(const JsonField& shot) {
  constexpr double kAssumed = 60.0, kMost = 1e6;  // °, px
  constexpr std::array<const char*, 5> kIntrinsics = {"fx", "fy", "cx", "cy", "distortion"};
  collision::ShotCamera c;
  const auto assume = [&] {
    c.hfov = radians(kAssumed);
    c.assumed = true;
    return c;
  };
  if (!shot.has("camera")) return assume();
  const JsonField json = shot["camera"];
  json.allow_only({"fx", "fy", "cx", "cy", "distortion", "width", "height", "hfov_deg", "assumed", "readout"});
  if (json.has("assumed")) c.assumed = json["assumed"].truth();
  if (json.has("readout")) c.readout = json["readout"].number(-1.0, 1.0);
  if (json.has("width") != json.has("height")) json.fail("width and height, or neither");
  if (json.has("width")) {
    c.camera.width = json["width"].index(kMostPixels);
    c.camera.height = json["height"].index(kMostPixels);
    if (c.camera.width < 1 || c.camera.height < 1) json["width"].fail("a size above 0");
  }
  if (json.has("hfov_deg")) {
    for (const char* key : kIntrinsics)
      if (json.has(key)) json[key].fail("either hfov_deg alone, or fx, fy, cx, cy");
    c.hfov = radians(json["hfov_deg"].number(1.0, 170.0));
    return c;
  }
  const auto has = [&](const char* key) { return json.has(key); };
  if (std::none_of(kIntrinsics.begin(), kIntrinsics.end(), has)) return assume();
  for (const char* key : {"fx", "fy", "cx", "cy"})
    if (!json.has(key)) json.fail(fmt::format("fx, fy, cx and cy in pixels ({} is missing), or hfov_deg", key));
  c.camera.fx = json["fx"].number(1e-3, kMost);
  c.camera.fy = json["fy"].number(1e-3, kMost);
  c.camera.cx = json["cx"].number(-kMost, kMost);
  c.camera.cy = json["cy"].number(-kMost, kMost);
  if (!json.has("distortion")) return c;
  const auto values = json["distortion"].list();
  if (values.size() != 4 && values.size() != 5) json["distortion"].fail("k1, k2, p1, p2 and perhaps k3, as OpenCV has them");
  for (std::size_t i = 0; i < values.size(); ++i) c.distortion[i] = values[i].number(-1e3, 1e3);
  return c;
}

Shot read_shot(const std::filesystem::path& path) {
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestFile), path.string(), "a shot file");
  const JsonField json(parsed, path.string());
  json.allow_only({"video", "observations", "fps", "camera", "gravity", "down", "bodies", "roi", "frames", "orientations",
                   "metres_per_pixel", "floor"});
  const std::filesystem::path folder = path.parent_path();
  Shot shot;
  shot.name = path.string();
  shot.bodies = read_bodies(json["bodies"], folder);
  shot.camera = read_shot_camera(json);
  read_footage(shot, json, folder);
  if (json.has("gravity")) shot.gravity = json["gravity"].number(0, kMostGravity);
  if (json.has("down")) shot.down = read_direction(json["down"]);
  if (json.has("roi")) shot.roi = read_roi(json["roi"]);
  if (json.has("frames")) shot.frames = read_frames(json["frames"]);
  if (json.has("floor")) shot.floor = read_floor(json["floor"]);
  if (json.has("orientations"))
    for (const JsonField& field : json["orientations"].list()) shot.orientations.push_back(read_orientation(field, shot));
  if (json.has("metres_per_pixel")) {
    if (shot.gravity > 0) json["metres_per_pixel"].fail("none unless \"gravity\" is 0: gravity gives the scale");
    shot.metres_per_pixel = json["metres_per_pixel"].number(1e-8, 10.0);
  }
  return shot;
}

}  // namespace unseen::report
