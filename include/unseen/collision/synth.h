// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "unseen/collision/types.h"
#include "unseen/core/context.h"
#include "unseen/core/options.h"

namespace unseen::collision {

/// What collision to simulate and how to film it. Angles in degrees, as on the command line.
struct SynthOptions {
  std::string scene = "boxes";  ///< one of synth_scenes()
  std::optional<double> restitution;  ///< unset: drawn from the seed
  std::optional<double> mass_ratio;   ///< second body to first; unset: drawn
  double friction = 0.0;              ///< coefficient at the contact
  std::optional<double> spin;         ///< rad/s, of both bodies before the impact; unset: drawn
  double fps = 240.0;
  int frames = 0;            ///< 0 = the scene's own number
  int width = 1280, height = 720;
  bool video = true;         ///< false: the truth and exact tracks only
  double exposure = 0.25;    ///< share of a frame's time that the shutter is open: motion blur
  double noise = 3.0;        ///< σ of the sensor, grey levels of 255
  bool shadow = true;        ///< the bodies cast a shadow on the wall behind
  bool curtain = false;      ///< something hides the impact
  double centroid_noise = 0.0;     ///< share of the larger body's projected size: uniform noise of the tracks
  double orientation_noise = 0.0;  ///< deg, of the orientations given
  int orientations = 2;            ///< orientations given a flight
  int gap = 0;                     ///< frames around the impact without any observation
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(SynthOptions& options);

/// boxes, box-ball, ball-floor, box-floor, balls, offcentre, spin, mesh, planar, drag, rain (several), flight (no collision).
const std::vector<std::string>& synth_scenes();

/// What really happens in the shot. World: z up, origin at the camera's centre, as in Reconstruction.
struct Truth {
  std::string scene;
  RigidTransform T_world_camera;
  Camera camera;
  double fps = 0;
  std::vector<Body> bodies;
  std::vector<Impact> impacts;            ///< sd, low and high are 0
  std::optional<double> restitution, mass_ratio;
  std::vector<FramePose> frames;          ///< before any noise
};

/// A simulated shot: the truth, what SHOT.json says (video = "shot.mp4", or exact tracks as observations), and its pictures.
struct SynthShot {
  Truth truth;
  Shot shot;
};

/// Simulates free flight and rigid impact in closed form and by a fine Runge–Kutta of Euler's equations, with Coulomb friction at the
/// contact; shares no code with the solver. Same options, same bytes. Throws InputError for options outside their range, or under
/// which no shot of the scene comes about. Without a video, `shot.observations` are projected centres of mass with the radius of a disc
/// of the silhouette's area, in all frames in which they lie in the picture, and `shot.orientations` are spread evenly over each flight.
/// The shot ends early where a body comes to rest, and box-floor before its second contact. The floor of rain is no body: bounces off it
/// are in the motion but not among the impacts. Planar shots of odd seeds tell metres_per_pixel beside the bodies' sizes.
SynthShot simulate(const SynthOptions& options);

/// The shot's frames, 8-bit BGR, row by row, one after the other; what `film` is called with. Deterministic.
void render(const SynthShot& scene, const SynthOptions& options, Context& context,
            const std::function<void(int frame, const std::vector<std::uint8_t>& bgr)>& film);

}  // namespace unseen::collision
