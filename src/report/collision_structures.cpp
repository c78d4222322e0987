// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/collision_motion.h"
#include "report/moving_bodies.h"

namespace unseen::report {
namespace {

using namespace collision;

constexpr int kHues = 8;  // of labels: from the ninth on they repeat lighter and darker, so that a body's flights have one hue

/// The shape of a body; without the shot a ball of the same inertia.
Json shape_of(SceneBuilder& scene, const Shot& shot, const Reconstruction& r, std::size_t b) {
  if (b < shot.bodies.size()) return shape_of(scene, shot.bodies[b], b);
  return ball_shape(2.0 * std::sqrt(2.5 * (b < r.bodies.size() ? r.bodies[b].inertia.mean() : 1e-3)));
}

/// Pixels between where a body was seen and where the solution has it, by the time of the frame, s.
std::map<double, double> distances(const Reconstruction& r, int body) {
  std::map<int, double> time_of;
  for (const FramePose& f : r.frames) time_of[f.frame] = f.time;
  std::map<double, double> by_time;
  for (const Residual& x : r.residuals)
    if (const auto at = time_of.find(x.frame); x.body == body && at != time_of.end()) by_time[at->second] = (x.seen - x.predicted).norm();
  return by_time;
}

}  // namespace

void add_bodies(SceneBuilder& scene, const Shot& shot, const Reconstruction& r) {
  std::vector<Moving> bodies;
  for (int b = 0; b < 2; ++b) {
    Motion motion = motion_of(r, b, shot.gravity);
    if (!motion.times.empty()) bodies.push_back({name_of(r, b), b, std::move(motion), shape_of(scene, shot, r, static_cast<std::size_t>(b))});
  }
  add_moving(scene, bodies);
}

void add_fixed(SceneBuilder& scene, const Shot& shot, const Reconstruction& r) {
  add_quad(scene, "fixed", r.fixed.empty() ? "floor" : r.fixed, fixed_quad(shot, r));
}

void add_flights(SceneBuilder& scene, const Reconstruction& r, double gravity) {
  std::vector<Vec3> ends;
  std::vector<int> flight;
  std::vector<float> residual;
  std::vector<std::string> names;
  double highest = 1e-3;
  for (int b = 0; b < 2; ++b) {
    const Motion motion = motion_of(r, b, gravity);
    const std::map<double, double> off = distances(r, b);
    for (std::size_t i = 0; i + 1 < motion.times.size(); ++i) {
      const double middle = 0.5 * (motion.times[i] + motion.times[i + 1]);
      const int leg = static_cast<int>(std::count_if(r.impacts.begin(), r.impacts.end(), [&](const Impact& x) {
        return x.time < middle && (x.between[0] == b || x.between[1] == b);
      }));
      const int label = b + kHues * leg;
      if (names.size() <= static_cast<std::size_t>(label)) names.resize(static_cast<std::size_t>(label) + 1);
      names[static_cast<std::size_t>(label)] = fmt::format("{}, flight {}", name_of(r, b), leg + 1);
      ends.push_back(motion.positions[i]);
      ends.push_back(motion.positions[i + 1]);
      flight.push_back(label);
      const auto at = off.find(motion.times[i]);
      residual.push_back(at == off.end() ? std::nanf("") : static_cast<float>(at->second));
      if (at != off.end()) highest = std::max(highest, at->second);
    }
  }
  if (flight.empty()) return;
  Json& lines = scene.add("lines", "flights", "Flights");
  lines["vertices"] = scene.positions(ends);
  Json label = quantity("flight", "Flight", "label", scene.integers(flight));
  label["names"] = names;
  Json off = quantity("residual", "Residual", "scalar", scene.scalars(residual), "px");
  off["low"] = 0.0;
  off["high"] = number(highest);
  lines["quantities"] = {label, off};
}

void add_impacts(SceneBuilder& scene, const Reconstruction& r) {
  if (r.impacts.empty() || !r.fits) return;
  std::vector<Vec3> origins, vectors;
  std::vector<int> kind;
  for (const Impact& impact : r.impacts) {
    for (const double sign : {1.0, -1.0}) {
      origins.push_back(impact.contact_point);
      vectors.push_back(sign * impact.impulse);
      kind.push_back(impact.between[sign > 0 ? 0 : 1]);
    }
    origins.push_back(impact.contact_point);
    vectors.push_back(0.6 * impact.impulse.norm() * impact.normal);
    kind.push_back(2);
  }
  Json& arrows = scene.add("arrows", "impulses", "Impulses, normals");
  arrows["origins"] = scene.positions(origins);
  arrows["vectors"] = scene.vectors(vectors);
  Json label = quantity("on", "What it is", "label", scene.integers(kind));
  label["names"] = {"impulse on " + name_of(r, 0), "impulse on " + name_of(r, 1), "normal"};
  arrows["quantities"].push_back(label);
}

void add_clip(SceneBuilder& scene, const Reconstruction& r, const std::vector<OverlayPicture>& pictures) {
  if (!pictures.empty()) {
    std::vector<float> times;
    Json frames = Json::array();
    for (const OverlayPicture& p : pictures) {
      times.push_back(static_cast<float>(p.time));
      frames.push_back(scene.bytes(p.jpeg));
    }
    Json& clip = scene.add("image", "clip", r.frames.empty() ? "The clip with what was seen to move: grey is in no flight" : "The clip with the solution drawn over it");
    clip["width"] = pictures.front().width;
    clip["height"] = pictures.front().height;
    clip["format"] = "image/jpeg";
    clip["frames"] = std::move(frames);
    clip["times"] = scene.scalars(times);
    if (r.frames.empty()) scene.header["time"] = {{"start", number(times.front())}, {"end", number(times.back())}};  // nothing else moves
  }
  if (!(r.camera.fx > 0) || r.camera.width <= 0) return;
  Json& camera = scene.add("camera", "camera", "Camera");
  write_camera(camera, r.T_world_camera, r.camera);
  if (!pictures.empty()) camera["image"] = "clip";
}

void add_residual_chart(SceneBuilder& scene, const Reconstruction& r) {
  Json series = Json::array();
  for (int b = 0; b < 2; ++b)
    for (const bool used : {true, false}) {
      std::vector<float> x, y;
      for (const Residual& residual : r.residuals)
        if (residual.body == b && residual.used == used) {
          x.push_back(static_cast<float>(residual.frame));
          y.push_back(static_cast<float>((residual.seen - residual.predicted).norm()));
        }
      if (x.empty()) continue;
      series.push_back({{"name", name_of(r, b) + (used ? "" : ", not used")}, {"color", b}, {"hollow", !used}, {"x", scene.scalars(x)}, {"y", scene.scalars(y)}});
    }
  if (series.empty()) return;
  Json marks = Json::array();
  for (const Impact& impact : r.impacts) marks.push_back({{"x", number(impact.frame)}, {"name", "impact"}});
  scene.header["charts"].push_back({{"title", "Residuals"},
                                    {"x", {{"name", "frame"}, {"unit", ""}, {"seconds", number(1.0 / r.fps)}}},
                                    {"y", {{"name", "distance from where it was seen"}, {"unit", "px"}}},
                                    {"series", std::move(series)},
                                    {"marks", std::move(marks)}});
}

}  // namespace unseen::report
