// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/synth.h"

#include <algorithm>
#include <limits>

#include "collision/synth/synth_plan.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr int kDraws = 4000;

void check(const SynthOptions& options) {
  check_options(options, "synth");
  const bool alone = options.scene == "ball-floor" || options.scene == "box-floor" || options.scene == "drag";
  if (alone && options.mass_ratio)
    throw InputError("synth", "mass_ratio", std::to_string(*options.mass_ratio), "nothing, for what " + options.scene + " hits is fixed");
  if (options.scene == "flight" && options.restitution)
    throw InputError("synth", "restitution", std::to_string(*options.restitution), "nothing, for flight has no collision");
}

/// What the shot file says of it: the truth of its scene, but not of its motion.
Shot shot_of(const SynthPlan& plan, const Truth& truth, const SynthOptions& options) {
  Shot shot;
  shot.name = options.scene;
  shot.fps = options.fps;
  shot.camera.camera = truth.camera;
  shot.gravity = plan.gravity.norm();
  shot.bodies = plan.bodies;
  if (plan.gravity.isZero() && options.seed % 2 == 1)
    shot.metres_per_pixel = (truth.T_world_camera.inverse() * truth.frames.front().bodies[0]->p).z() / truth.camera.fx;
  if (plan.floor && plan.movers.size() == 2) {
    const Vec3 up = truth.T_world_camera.rotation.transpose() * plan.floor->normal;  // the world's origin is the camera's centre
    shot.floor = Plane{up, plan.floor->offset};
  }
  if (options.video)
    shot.video = "shot.mp4";
  else
    observe(truth, options, shot);
  return shot;
}

}  // namespace

const std::vector<std::string>& synth_scenes() {
  static const std::vector<std::string> kScenes = {"boxes",     "box-ball",  "ball-floor", "box-floor", "balls", "offcentre",
                                                   "spin",      "mesh",      "planar",     "drag",      "rain",  "flight"};
  return kScenes;
}

OptionTable describe(SynthOptions& o) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table;
  // clang-format off
  table.add({"scene", &o.scene, "", "what collides; rain collides several times, flight not at all", -kInf, kInf, synth_scenes()});
  table.add({"restitution", &o.restitution, "1", "coefficient of restitution; unset = drawn, 0.2 to 0.85", 0, 1, {}});
  table.add({"mass_ratio", &o.mass_ratio, "1", "mass of the second body to that of the first; unset = drawn, 0.6 to 2", 0.05, 20, {}});
  table.add({"friction", &o.friction, "1", "coefficient of friction at the contact", 0, 10, {}});
  table.add({"spin", &o.spin, "rad/s", "angular speed of the bodies before the impact; unset = drawn", 0, 100, {}});
  table.add({"fps", &o.fps, "1/s", "frames a second", 10, 2000, {}});
  table.add({"frames", &o.frames, "", "length of the shot; 0 = as the scene has it. A body that comes to rest ends it", 0, 5000, {}});
  table.add({"width", &o.width, "px", "of the picture", 64, 8192, {}});
  table.add({"height", &o.height, "px", "of the picture", 64, 8192, {}});
  table.add({"video", &o.video, "", "film it; false = tracks of the centres and some orientations instead", -kInf, kInf, {}});
  table.add({"exposure", &o.exposure, "1", "share of a frame's time that the shutter is open", 0, 1, {}});
  table.add({"noise", &o.noise, "1", "standard deviation of the sensor in grey levels of 255", 0, 64, {}});
  table.add({"shadow", &o.shadow, "", "the bodies cast shadows", -kInf, kInf, {}});
  table.add({"curtain", &o.curtain, "", "something before the scene hides the impact", -kInf, kInf, {}});
  table.add({"centroid_noise", &o.centroid_noise, "1", "uniform noise of the tracks: at most this share of the larger body's projected diameter", 0, 1, {}});
  table.add({"orientation_noise", &o.orientation_noise, "deg", "standard deviation of the orientations that come with the tracks", 0, 180, {}});
  table.add({"orientations", &o.orientations, "", "how many of them a flight and body", 0, 1000, {}});
  table.add({"gap", &o.gap, "", "frames about each impact that the tracks leave out", 0, 5000, {}});
  table.add({"seed", &o.seed, "", "seed of everything random", 0, 2147483647, {}});
  // clang-format on
  return table;
}

SynthShot simulate(const SynthOptions& options) {
  check(options);
  const auto scene = std::find(synth_scenes().begin(), synth_scenes().end(), options.scene) - synth_scenes().begin();
  Random random(static_cast<std::uint64_t>(options.seed) * 64 + static_cast<std::uint64_t>(scene));
  SynthShot result;
  for (int draw = 0; draw < kDraws; ++draw) {
    const SynthPlan plan = draw_plan(options, random);
    Truth& truth = result.truth;
    if (!carry_out(plan, options, truth) || !well_seen(plan, options, truth)) continue;
    truth.scene = options.scene;
    truth.T_world_camera = plan.T_world_camera;
    truth.camera = plan.camera;
    truth.fps = options.fps;
    truth.bodies = plan.bodies;
    if (plan.hit) truth.restitution = plan.restitution;
    if (plan.movers.size() == 2) truth.mass_ratio = plan.movers[1].mass;
    result.shot = shot_of(plan, truth, options);
    return result;
  }
  throw InputError("synth", "scene", options.scene + " with these options",
                   "options under which bodies can be filmed before and after they meet");
}

}  // namespace unseen::collision
