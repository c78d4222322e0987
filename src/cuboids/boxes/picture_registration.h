// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/boxes/edge_search.h"

namespace unseen::cuboids {

/// Where in the colour image a pixel of the depth image is: shifted, and scaled about the camera's centre, across and down.
struct PictureRegistration {
  Vec2 center = Vec2::Zero(), shift = Vec2::Zero(), scale = Vec2::Ones();

  Vec2 to_picture(const Vec2& p) const { return center + scale.cwiseProduct(p - center) + shift; }
  Vec2 to_depth(const Vec2& q) const { return center + (q - shift - center).cwiseQuotient(scale); }
};

/// The one that brings edges of boxes, as pixels of the depth image, closest to the picture's. Creases, where two seen sides meet, tell a shift: at
/// silhouettes depth falls short, on one side more than on the other. Another scale is believed only where all edges clearly say so.
PictureRegistration register_picture(const ImageEdges& edges, const std::vector<Vec2>& creases, const std::vector<Vec2>& all, const Vec2& center);

}  // namespace unseen::cuboids
