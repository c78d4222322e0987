// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::report {

/// The part of a box that was seen, m, from its centre along its own axes. Empty (low = high) if nothing was.
struct SeenPart {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  bool is_empty() const { return !((high - low).minCoeff() > 0.0); }
};

/// The initial box within the completed one; what differs by less than rounding to a measurement counts as seen.
SeenPart seen_part(const cuboids::Cuboid& cuboid);
/// The seen part as a box.
OrientedBox seen_box(const cuboids::Cuboid& cuboid);
/// What was inferred: the completed box without the part that was seen, as at most six boxes that do not overlap.
std::vector<OrientedBox> hidden_boxes(const cuboids::Cuboid& cuboid);

/// "box 3 (tea)", or "box 3" without a label.
std::string name_of(const cuboids::Cuboid& cuboid);
/// "desk 0"
std::string name_of(const cuboids::Support& support);
/// "1 0.5 0": a vector as an attribute of an XML element.
std::string attribute_of(const Vec3& v);

/// Corners of a box: bit k of the index tells the side along axis k.
std::vector<Vec3> corners_of(const OrientedBox& box);
/// What is drawn of a support: its outline, or a rectangle that what stands there needs. Counter-clockwise seen from
/// the tip of its normal.
std::vector<Vec3> polygon_of(const cuboids::Support& support, const cuboids::Completion& completion);

/// Bodies that fixed contacts make one. Ids of supports are in no group.
struct RigidGroup {
  std::vector<std::size_t> cuboids;  ///< indices, ascending
  int support = -1;                  ///< id of a support that they are fixed to, −1 = none
};
/// Groups in the order of their first cuboid.
std::vector<RigidGroup> rigid_groups(const cuboids::Completion& completion);

/// The measured points of a frame, in the world, with the colours of the photograph (none if there is none). At most
/// about `limit` of them, evenly.
struct DepthPoints {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::size_t seen = 0;  ///< measured points in all
};
DepthPoints depth_points(const RgbdFrame& frame, const RigidTransform& T_world_camera, std::size_t limit);

/// The cuboid (index) that each point belongs to: the one it lies in or, within a measurement's tolerance, on; −1 = none.
std::vector<int> cuboid_of_point(const std::vector<Vec3>& points, const std::vector<cuboids::Cuboid>& cuboids);

}  // namespace unseen::report
