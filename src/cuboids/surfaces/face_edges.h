// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "cuboids/surfaces/faces.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

constexpr std::size_t kFewestEdgeLinks = 4;  ///< fewer tell nothing of an edge

/// Where two faces meet.
struct FaceEdge {
  std::array<std::vector<int>, 2> ends;  ///< points on either side, of the face with the lower number first
  Vec3 place = Vec3::Zero();             ///< middle of the links
  bool concave = false;                  ///< a crease: one thing ends here and another begins
  bool joins = false;                    ///< they meet, convexly or smoothly
  std::size_t links() const { return ends[0].size(); }
};
using FaceEdges = std::map<std::pair<int, int>, FaceEdge>;  ///< by the numbers of the faces, the lower one first

/// Every point of a non-negative group gets the nearest (in links) face of that group; −1 where none can be reached.
std::vector<int> nearest_faces(const Faces& faces, const PointGraph& graph, std::span<const int> group);

/// Edges between faces, where points of one (`owner` says which have it) are linked with points of another.
FaceEdges find_face_edges(const Observation& seen, const Faces& faces, std::span<const int> owner);

}  // namespace unseen::cuboids
