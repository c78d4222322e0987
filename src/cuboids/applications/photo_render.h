// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/applications/patch_match.h"
#include "cuboids/applications/photo_scene.h"

namespace unseen::cuboids {

/// What moved bodies look like from the camera.
struct Foreground {
  std::vector<float> depth;  ///< m; infinite where there is none
  std::vector<Color> color;
  std::vector<int> cuboid;  ///< index, −1 = none
};
/// Each body as a relief of what was seen of it, textured from the photograph, and its boxes where nothing was seen.
Foreground render_moved(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                        const PhotoScene& photo, const PhotoEditOptions& options, const Context& context);

/// Share of a broad light overhead that moved bodies keep off each visible background point, in [0,1].
std::vector<float> shadow_of_moved(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                                   const PhotoScene& photo, const Context& context);

}  // namespace unseen::cuboids
