// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/synth/synth_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace unseen::collision {
namespace {

constexpr double kGamma = 2.2;
constexpr double kBehind = 0.35;  // m, of the wall behind the farthest body
constexpr int kPictures = 14;

/// Blue, green, red from hue (in turns), saturation and value, linear.
Vec3 color(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + 6 * hue, 6.0);
    return linear(255 * (value - value * saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0)));
  };
  return {channel(1), channel(3), channel(5)};
}

/// Smooth noise in [0, 1]: lattice values, blended.
double value_noise(double x, double y, std::uint64_t seed) {
  const auto at = [&](std::int64_t i, std::int64_t j) {
    std::uint64_t h = seed + 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(i) + 0xC2B2AE3D27D4EB4FULL * static_cast<std::uint64_t>(j);
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1.0p-53;
  };
  const double fx = std::floor(x), fy = std::floor(y), u = x - fx, v = y - fy;
  const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
  const double a = u * u * (3 - 2 * u), b = v * v * (3 - 2 * v);
  return (at(i, j) * (1 - a) + at(i + 1, j) * a) * (1 - b) + (at(i, j + 1) * (1 - a) + at(i + 1, j + 1) * a) * b;
}

double rough(double x, double y, std::uint64_t seed) {
  return 0.6 * value_noise(x, y, seed) + 0.3 * value_noise(3.1 * x, 3.1 * y, seed + 1) + 0.1 * value_noise(11 * x, 11 * y, seed + 2);
}

/// A framed rectangle on the wall.
struct Picture {
  double x, z, width, height;
  Vec3 color;
};

std::vector<Picture> hang(Random& random) {
  std::vector<Picture> all;
  for (int i = 0; i < kPictures; ++i) {
    const double x = random.uniform(-3, 3), z = random.uniform(-1.8, 1.8);
    const double width = random.uniform(0.15, 0.7), height = random.uniform(0.15, 0.7), hue = random.uniform();
    all.push_back({x, z, width, height, color(hue, 0.25, random.uniform(0.45, 0.85))});
  }
  return all;
}

Vec3 wall_color(double x, double z, const std::vector<Picture>& pictures, std::uint64_t seed) {
  Vec3 c = color(0.12, 0.12, 0.62 + 0.16 * rough(1.7 * x, 1.7 * z, seed));
  for (const Picture& p : pictures) {
    const double u = std::abs(x - p.x) / p.width * 2, v = std::abs(z - p.z) / p.height * 2;
    if (std::max(u, v) > 1) continue;
    c = std::max(u, v) > 0.9 ? color(0.08, 0.4, 0.35) : Vec3(p.color * (0.7 + 0.5 * rough(6 * x, 6 * z, seed + 7)));
  }
  return c;
}

Vec3 floor_color(double x, double y, std::uint64_t seed) {
  const double seam = x / 0.22 - std::floor(x / 0.22) < 0.03 ? 0.75 : 1.0;
  return seam * color(0.07, 0.35, 0.5 + 0.15 * rough(5 * x, 1.5 * y, seed + 13));
}

double find_wall(const SynthShot& scene) {
  double wall = 0;
  for (const FramePose& f : scene.truth.frames)
    for (std::size_t i = 0; i < scene.truth.bodies.size(); ++i)
      if (f.bodies[i]) wall = std::max(wall, f.bodies[i]->p.y() + synth_body(scene.truth.bodies[i]).reach);
  return scene.shot.gravity > 0 ? wall + kBehind : wall;
}

std::optional<double> find_floor(const SynthShot& scene) {
  if (scene.shot.floor) return scene.shot.floor->offset;
  for (const Impact& i : scene.truth.impacts)
    if (scene.truth.bodies[static_cast<std::size_t>(i.between[1])].shape == Shape::fixed) return i.contact_point.z();
  return std::nullopt;
}

}  // namespace

double encoded(double linear) { return 255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / kGamma); }
double linear(double level) { return std::pow(level / 255, kGamma); }

Vec3 to_lamp() { return Vec3(-0.35, -0.62, 0.7).normalized(); }
double lit(const Vec3& normal) { return 0.4 + 0.6 * std::max(0.0, normal.dot(to_lamp())); }

Paint::Paint(const SynthBody& body, int number) : ball_(body.sphere()) {
  const double hue = number == 0 ? 0.0 : 0.55, scale = 1 / (0.3 * body.reach);
  if (ball_) coats_.push_back({Vec3::Zero(), Vec3::Zero(), {color(hue + 0.12, 0.35, 0.98), color(hue, 0.85, 0.9)}});
  for (std::size_t i = 0; i < body.faces.size(); ++i) {
    const double own = std::fmod(hue + 0.37 * static_cast<double>(i), 1.0);
    const Vec3 u = any_orthogonal(body.faces[i].normal), v = body.faces[i].normal.cross(u);
    coats_.push_back({scale * u, scale * v, {color(own, 0.7, 0.95), color(own, 0.8, 0.5)}});
  }
}

const Vec3& Paint::at(int face, const Vec3& place) const {
  if (ball_) return coats_[0].colors[((place.x() > 0) != (place.y() > 0)) != (place.z() > 0)];
  const Coat& coat = coats_[static_cast<std::size_t>(face)];
  const double x = place.dot(coat.u), y = place.dot(coat.v);
  const auto odd = [](double t) { return (static_cast<int>(std::floor(t)) & 1) != 0; };
  return coat.colors[face % 3 == 0 ? odd(x) != odd(y) : face % 3 == 1 ? odd(x + 0.5 * y) : odd(std::hypot(x - 0.7, y - 0.4))];
}

Backdrop make_backdrop(const SynthShot& scene, std::uint64_t seed, Context& context) {
  Backdrop b;
  b.wall = find_wall(scene);
  b.floor = find_floor(scene);
  Random random(seed * 31 + 5);
  const std::vector<Picture> pictures = hang(random);
  const Camera& camera = scene.truth.camera;
  const Mat3& R = scene.truth.T_world_camera.rotation;
  const auto look = [&](double u, double v, Vec3& place) {
    const Vec3 d = R * camera.unproject(u, v, 1.0);
    const double to_wall = d.y() > 0 ? b.wall / d.y() : std::numeric_limits<double>::infinity();
    const double to_floor = b.floor && d.z() * *b.floor > 0 ? *b.floor / d.z() : std::numeric_limits<double>::infinity();
    place = std::min({to_wall, to_floor, 100.0}) * d;
    if (to_floor < to_wall) return Vec3(lit(Vec3::UnitZ()) * floor_color(place.x(), place.y(), seed));
    return Vec3(lit(-Vec3::UnitY()) * wall_color(place.x(), place.z(), pictures, seed));
  };
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  b.places.resize(pixels);
  b.colors.resize(pixels);
  parallel_blocks(context, pixels, 1 << 13, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double u = static_cast<double>(i % camera.width), v = static_cast<double>(i / camera.width);
      Vec3 sum = Vec3::Zero(), corner;
      for (int k = 0; k < 4; ++k) sum += look(u + (k & 1 ? 0.25 : -0.25), v + (k & 2 ? 0.25 : -0.25), corner);
      b.colors[i] = sum / 4;
      (void)look(u, v, b.places[i]);
    }
  });
  return b;
}

}  // namespace unseen::collision
