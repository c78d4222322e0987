// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"
#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// An orientation of a body as an observation. `q` maps the body's file axes to the camera.
struct Orientation {
  int body = 0;
  double time = 0;    ///< s
  Quat q = Quat::Identity();
  double sigma = 0.0872664625997165;  ///< rad
};

/// A flight's rotation that its silhouettes and its looks agree with: orientation and angular velocity (of unit mass momentum) at
/// the flight's end nearest the impact, with the cost that ranks it against the other candidates of the same flight.
struct Spin {
  int span = 0;      ///< index into Tracks::spans
  double time = 0;   ///< s, of `q` and `omega`
  Quat q = Quat::Identity();
  Vec3 omega = Vec3::Zero();  ///< rad/s, camera axes, at `time`
  double cost = 0;            ///< smaller is better; differences count as χ²
  std::vector<Orientation> orientations;  ///< one a frame that was looked at
};

/// Candidates for the rotation of each flight of the bodies that have a shape other than a sphere, by rendering them and comparing
/// (thesis Section 5.3.3, without a person): best first, at most `keep` a flight. `centers` are the flights' positions in camera
/// coordinates, one a point of `tracks`.
std::vector<std::vector<Spin>> find_spins(const Shot& shot, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                                          const std::vector<Vec3>& centers, int keep, Context& context);

}  // namespace unseen::collision
