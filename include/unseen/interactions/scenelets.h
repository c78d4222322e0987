// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

inline constexpr int kDescriptorPoses = 15, kJointLines = 14;  ///< thesis Section 6.2.2.1
inline constexpr int kGrid = 5;                                ///< bins a side, thesis Section 6.2.2.2

/// A short motion with the objects around it, in the frame of the pelvis at its middle (z = 0 stays the floor).
struct Scenelet {
  int recording = 0;  ///< index into Database::recordings
  int person = 0, center = 0;  ///< frame of the recording
  double fps = 10;
  std::vector<Pose> poses;  ///< evenly spaced at fps; the middle one is at `middle`
  int middle = 0;
  Placement origin;  ///< of its frame in the recording's world; says how densely that place is covered
  std::vector<bool> valid;  ///< poses that were recorded; others are interpolated
  std::vector<Action> actions;
  std::vector<Object> objects;
  std::vector<float> layout;    ///< Φ, [category][row][column]
  std::vector<float> saliency;  ///< h, the same places
  double highest_saliency = 0;  ///< H in [0,1]: above what any motion has, see src/interactions/database/saliency.h
};

struct Source {
  std::string name, room, licence;
};

struct Database {
  std::vector<Source> recordings;
  std::vector<Scenelet> scenelets;
};

struct SceneletOptions {
  double arc_length = 0.6;     ///< m of the smoothed pelvis path that a scenelet covers
  double step = 0.1;           ///< m of path between two scenelets
  double longest = 2.0;        ///< s; who sits still covers no path
  double reach = 1.0;          ///< m, objects within it of the path on the ground
  double motion_sigma = 0.13;  ///< m, of the Gaussian in motion distance
};

/// The one description of these options; the table points into `options`.
OptionTable describe(SceneletOptions& options);

/// Cuts recordings into scenelets, with descriptors and saliency (over all of them together). Throws InputError (the recording's name)
/// for frames out of order, what is not finite or farther than 1 km, and boxes that are none.
Database build_database(const std::vector<Recording>& recordings, const SceneletOptions& options, Context& context);

/// One database of several, each recording once; saliency is computed anew over all.
Database join(const std::vector<Database>& databases, const SceneletOptions& options, const Context& context);

/// The 14 distances of joints to lines of a pose, m (thesis Section 6.2.2.1): knees to hip–ankle, elbows to shoulder–wrist, hips to
/// shoulder–knee (each right, left), then knees, ankles, wrists (right, left) and head to pelvis–thorax, and pelvis to ankle–ankle.
Eigen::Matrix<double, kJointLines, 1> joint_line_distances(const Pose& pose);

/// Ψ of a motion: poses evenly spaced along its curve in the 17-D space of distances and pelvis position, so independent of speed and frame.
Eigen::Matrix<float, kJointLines, kDescriptorPoses> motion_descriptor(const std::vector<Pose>& poses);

/// Weighted distance of two motion descriptors; the middle weighs most. m
double motion_distance(const Eigen::Matrix<float, kJointLines, kDescriptorPoses>& a, const Eigen::Matrix<float, kJointLines, kDescriptorPoses>& b);

inline constexpr double kBin = 0.52;  ///< m; the grid's half side of 1.3 m is the default reach and half the default arc length

/// Φ: for each category a grid of 5 × 5 bins around the origin, rows along y, columns along x; each with the largest
/// (area of an object's footprint in the bin) / min(area of the bin, area of the footprint).
std::vector<float> layout_descriptor(const std::vector<Object>& objects);

}  // namespace unseen::interactions
