// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/cuboids/truth.h"

namespace unseen::cuboids {

/// What scene to build and how to look at it. Angles in degrees, as on the command line.
struct SynthOptions {
  std::string scene = "tower";  ///< one of synth_families()
  int boxes = 0;                ///< tower, twisted, running-bond: how many; 0 = the family's own number
  int removed = 0;              ///< tower, twisted, running-bond, desk: boxes taken away again, the last ones first
  bool wall = false;            ///< put a wall behind the scene; then it is seen from the front only
  int view = -1;                ///< 0…4 = only this one of the five azimuths; −1 = all
  std::optional<double> azimuth;  ///< deg, one view from there instead; 0 = from the front, counter-clockwise from above
  double noise = 0.0015;          ///< m, σ of the depth at 1 m, quantisation included; grows with the square of the depth
  double dropout = 0.6;           ///< chance that a pixel at a depth edge has no depth; half of it one pixel further
  bool masks = false;             ///< name the masks in the frame file
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(SynthOptions& options);

/// The families that stand, then those that do not: "jam" and "bridge-without".
const std::vector<std::string>& synth_families();

/// One picture of the scene with its truth. Images row by row.
struct SynthView {
  int number = 0;      ///< of the azimuth, 0…4
  double azimuth = 0;  ///< rad
  Camera camera;
  std::vector<float> depth;                        ///< m along the axis, with noise and drop-out; 0 = unknown
  std::vector<float> exact_depth;                  ///< the same without
  std::vector<std::array<std::uint8_t, 3>> color;  ///< flat shaded
  std::vector<std::uint16_t> masks;                ///< index of the cuboid + 1, 0 = none
  Truth truth;
};

struct SynthScene {
  std::vector<SynthView> views;
};

/// Builds the scene and photographs it with a virtual depth camera (640 × 480, f = 525 px). The truth comes from how
/// the scene is built: two boxes are in contact if their faces share an area or an edge of one lies on a face of the
/// other; a contact is fixed only where the scene would fall otherwise. Same options, same bytes, at any thread count.
/// Throws InputError for options outside their range.
SynthScene make_scene(const SynthOptions& options, Context& context);

}  // namespace unseen::cuboids
