// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/rgbd_parts.h"
#include "io/text.h"
#include "unseen/core/error.h"
#include "unseen/io/rgbd.h"

namespace unseen::io {
namespace {

constexpr double kFarthest = 1e6;  // m, of a support: divided by the length of its normal it must stay finite
const std::vector<std::string> kKinds = {"ground", "desk", "wall", "ceiling"};

bool is_kind(const std::string& kind) {
  return std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
}

/// n·p = d stays what it is when both sides are divided by |n|.
Plane unit_plane(const Vec3& normal, double offset) {
  return {normal.normalized(), offset / normal.norm()};
}

/// Long enough to have a direction, and far from overflow.
bool is_direction(const Vec3& v) {
  return v.allFinite() && v.norm() > 1e-6 && v.norm() < 1e6;
}

GivenSupport parse_support(const std::string& text, const std::string& source) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  const auto fail = [&](const std::string& expected) { throw InputError(source, "support", shown(text), expected); };
  double numbers[4] = {};
  bool good = parts.size() == 4 || parts.size() == 5;
  for (std::size_t i = 0; good && i < 4; ++i) good = to_number(trim(parts[i]), numbers[i]) && std::isfinite(numbers[i]);
  if (!good) fail("nx,ny,nz,d or nx,ny,nz,d,kind");
  if (std::abs(numbers[3]) > kFarthest) fail(fmt::format("d within ±{:g}", kFarthest));
  const Vec3 normal(numbers[0], numbers[1], numbers[2]);
  if (!is_direction(normal)) fail("a normal that is not zero");
  const std::string kind = parts.size() == 5 ? std::string(trim(parts[4])) : "ground";
  if (!is_kind(kind)) fail(fmt::format("a kind of {}", fmt::join(kKinds, ", ")));
  return {unit_plane(normal, numbers[3]), kind};
}

Camera camera_of_matrix(const JsonField& field) {  // Open3D writes it column by column
  const auto k = field.list();
  if (k.size() != 9 || k[2].number() != 0.0 || k[5].number() != 0.0 || k[8].number() != 1.0) field.fail("nine numbers, column by column: fx, 0, 0, 0, fy, 0, cx, cy, 1");
  Camera camera;
  camera.fx = k[0].number();
  camera.fy = k[4].number();
  camera.cx = k[6].number();
  camera.cy = k[7].number();
  if (!(camera.fx > 0 && camera.fy > 0)) field.fail("positive focal lengths");
  return camera;
}

}  // namespace

Camera read_camera(const JsonField& json) {
  if (json.has("intrinsic_matrix")) return camera_of_matrix(json["intrinsic_matrix"]);
  constexpr double kMost = 1e6;
  json.members();  // fails unless it is an object
  for (const char* key : {"fx", "fy", "cx", "cy"})
    if (!json.has(key)) json.fail(fmt::format("fx, fy, cx and cy in pixels; {} is missing", key));
  Camera camera;
  camera.fx = json["fx"].number(1e-3, kMost);
  camera.fy = json["fy"].number(1e-3, kMost);
  camera.cx = json["cx"].number(-kMost, kMost);
  camera.cy = json["cy"].number(-kMost, kMost);
  return camera;
}

std::optional<double> read_depth_scale(const JsonField& json) {
  if (!json.has("depth_scale")) return std::nullopt;
  return json["depth_scale"].number(1e-9, 1e9);
}

std::optional<Vec3> read_up(const JsonField& json) {
  if (!json.has("up")) return std::nullopt;
  constexpr double kRounding = 0.01;  // files round
  const Vec3 up = json["up"].vector();
  if (!is_direction(up) || std::abs(up.norm() - 1.0) > kRounding)
    throw InputError(json.source(), "up", fmt::format("a vector of length {:.4g}", up.norm()),
                     "a vector of length 1 that points up, in the camera's coordinates");
  return up.normalized();
}

std::vector<GivenSupport> read_supports(const JsonField& json) {
  std::vector<GivenSupport> supports;
  if (!json.has("supports")) return supports;
  for (const JsonField& field : json["supports"].list()) {
    field.allow_only({"normal", "offset", "kind"});
    const Vec3 normal = field["normal"].vector();
    if (!is_direction(normal))
      throw InputError(json.source(), field["normal"].path(), fmt::format("a vector of length {:.4g}", normal.norm()),
                       "a normal that is not zero");
    const std::string kind = field.has("kind") ? field["kind"].text() : "ground";
    if (!is_kind(kind)) field["kind"].fail(fmt::format("one of {}", fmt::join(kKinds, ", ")));
    supports.push_back({unit_plane(normal, field["offset"].number(-kFarthest, kFarthest)), kind});
  }
  return supports;
}

std::vector<Stroke> read_strokes(const JsonField& json, const Camera& camera) {
  std::vector<Stroke> strokes;
  if (!json.has("strokes")) return strokes;
  for (const JsonField& field : json["strokes"].list()) {
    field.allow_only({"label", "points"});
    Stroke stroke;
    stroke.label = field["label"].text();
    for (const JsonField& point : field["points"].list()) {
      const auto xy = point.list();
      if (xy.size() != 2) point.fail("two numbers, x and y in pixels");
      const Vec2 p(xy[0].number(), xy[1].number());
      if (p.x() < 0 || p.y() < 0 || p.x() > camera.width - 1 || p.y() > camera.height - 1)
        throw InputError(json.source(), point.path(), fmt::format("({:.6g}, {:.6g})", p.x(), p.y()),
                         fmt::format("a pixel of the picture, 0…{} and 0…{}", camera.width - 1, camera.height - 1));
      stroke.points.push_back(p);
    }
    if (stroke.points.empty()) field["points"].fail("at least one point");
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

std::map<std::string, double> read_densities(const JsonField& json) {
  std::map<std::string, double> densities;
  if (!json.has("densities")) return densities;
  for (const auto& [label, field] : json["densities"].members()) densities[label] = field.number(1e-3, 1e5);
  return densities;
}

std::vector<GivenSupport> parse_supports(const std::string& text, const std::string& source) {
  std::vector<GivenSupport> supports;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    supports.push_back(parse_support(text.substr(at, end - at), source));
    at = end + 1;
  }
  return supports;
}

}  // namespace unseen::io
