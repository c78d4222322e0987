// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>

#include "collision/tracks/arcs.h"

namespace unseen::collision {

/// An impact between flights in space.
struct SpaceMeeting {
  double u = 0;        ///< frame times
  double misfit = 0;   ///< ½ χ² a sighting; 1 where nothing but noise is left
  std::array<Vec2, 2> pixels;  ///< of the bodies' centres then
  double least_change = 0;  ///< of the two bodies' changes of velocity across the view, each as a share of the faster one, before or after
  double opposed = 0;  ///< cosine between the two changes of velocity, across the view: along it they are hardly seen
};

/// When the flights of the shot's two bodies before (the first two arcs, a body each) and after meet: the time in [low, high] at which flights
/// in space explain them best. Parabolas of the picture lead astray where nobody sees the bodies for long: perspective bends them. Nothing if no
/// flights can be computed.
std::optional<SpaceMeeting> meet_in_space(const Shot& shot, const ShotCamera& camera, const std::array<const Arc*, 4>& arcs, double low, double high,
                                          double noise, double fps);

}  // namespace unseen::collision
