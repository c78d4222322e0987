// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "collision/tracks/tracks.h"

namespace unseen::collision {

/// Something that may be a body in one frame. Pixels without lens distortion, in the place of the first frame.
struct Candidate {
  int frame = 0;
  double u = 0;          ///< time in frame times: seconds times the frame rate
  Vec2 pixel = Vec2::Zero();
  double diameter = 0;   ///< px; 0 = unknown
  double area = 0;       ///< px²; 0 = unknown
  double round = 1;      ///< of what should be a disc: its least extent over the diameter of the bounding circle
  Vec3 color = Vec3::Zero();
  bool colored = false;  ///< `color` means something
  bool whole = true;     ///< not cut by the picture's edge
  bool shadow = false;
  int body = -1;         ///< where it is labelled
  int region = -1;
  int number = -1;       ///< of the frame in the file, where `frame` counts otherwise

  int file_frame() const { return number < 0 ? frame : number; }
};

using Candidates = std::vector<std::vector<Candidate>>;  ///< by frame

/// Which regions that could be shadows are taken for dark bodies: those that nothing but their light speaks against and that no body beside
/// them casts; or all of the first kind, and those of the background's colour that no body casts.
enum class DarkBodies { usual, all };

Candidates candidates_of(const Footage& footage, const ShotCamera& camera, bool spheres, DarkBodies dark = DarkBodies::usual);
Candidates candidates_of(const std::vector<Sighting>& sightings, const ShotCamera& camera);

/// What is or may be a body, in order of time; nothing if a frame has two of it.
std::vector<Candidate> sightings_of(const Candidates& candidates, int body);

/// The third difference of four in order of time, which no flight has, over what noise of 1 px makes of it; unevenly spaced ones too.
Vec2 off_any_flight(const std::array<const Candidate*, 4>& seen);

/// How unlike two candidates look, in σ², capped.
double unlikeness(const Candidate& a, const Candidate& b);

/// Median diameter of those that have one; 0 = none has.
double typical_diameter(const std::vector<Candidate>& candidates);

/// Leaves out points whose size is not that of the frames about them: a body that something covers in part, or that merges with another; off by a share of
/// `least` or more.
std::vector<Candidate> without_odd_sizes(const std::vector<Candidate>& points, double least);

}  // namespace unseen::collision
