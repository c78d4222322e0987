// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// What happens to one object: the named cuboid and all that are fixed to it, which are one rigid body.
struct PhotoEdit {
  int id = -1;                ///< of a cuboid
  bool remove = false;        ///< else it is moved
  Vec3 move = Vec3::Zero();   ///< m, world
  double turn = 0;            ///< radians about up, through the middle of the named cuboid, before the move
};

struct PhotoEditOptions {
  double margin = 0.02;   ///< m: points so near to a box belong to it, in [0, 1]
  double noise = 0.0015;  ///< σ of the depth at 1 m, m; grows with the square of the depth
  double shadow = 0.5;    ///< share of the light that a full shadow takes, in [0,1]
  std::uint64_t seed = 1;
};

/// The photograph after the edits, as large as the frame. Pixels that are neither hole, shown nor in shadow have the
/// bits of the frame.
struct EditedPhoto {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> pixels;  ///< sRGB
  std::vector<char> hole;     ///< 1 where an edited object was and the background was made up
  std::vector<int> shown;     ///< id of the moved cuboid that a pixel shows now, −1 = none
  std::vector<float> shadow;  ///< share of the light from above that moved objects keep off, in [0,1]
};

/// Moves and removes objects in the photograph of a frame (thesis, Section 4.5 (iii)): their pixels become a hole, which
/// patches of the rest fill; moved ones are ray-cast at their new place with what was seen of them, plain where they
/// were not seen, behind what stands before them, and keep the light from above off what lies below. The camera stays.
/// Throws InputError if the frame has no colour, an id is no cuboid's, or two edits are of one body.
EditedPhoto edit_photo(const RgbdFrame& frame, const Completion& scene, const std::vector<PhotoEdit>& edits,
                       const PhotoEditOptions& options, Context& context);

}  // namespace unseen::cuboids
