// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// What take to simulate.
struct SynthOptions {
  int people = 1;
  int objects = 4;      ///< pieces of furniture, 2 to 6
  double seconds = 40;  ///< length
  double fps = 10;
  double noise = 5;     ///< px, standard deviation of the joints
  int width = 1920, height = 1080;
  bool still = false;   ///< nobody touches anything
  bool lifted = true;   ///< 3D poses come with the detections
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(SynthOptions& options);

/// A simulated take: exact truth, and what a detector would say.
struct SynthTake {
  Recording truth;
  Take take;
};

/// People walk, turn, sit down, sit, stand up, reach, lean and lie among furniture; the camera is 0.8 to 1.8 m high and pitched by 0 to 10°;
/// joints are hidden by ray casting against boxes and bodies. Same options, same bytes. Throws InputError for options outside their range, and Cancelled if
/// `context` was asked to stop.
SynthTake simulate(const SynthOptions& options, const Context& context = {});

}  // namespace unseen::interactions
