// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/join_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cuboids/surfaces/face_edges.h"

namespace unseen::cuboids {
namespace {

constexpr int kFewestFacePoints = 30;
constexpr double kSliver = 6.0;  // widths, in noise or spacing

/// Strips as narrow as what a sensor blurs along an edge say nothing of their own: what is next to them gets them.
void leave_out_slivers(Faces& faces, const PointGraph& graph) {
  for (const Face& face : faces.faces) {
    const int i = face.points.front();
    const double blur = std::max(graph.sigma[i], graph.spacing[i]);
    if (face.width * std::sqrt(12.0) > kSliver * blur) continue;
    for (const int j : face.points) faces.face_of_point[j] = -1;
  }
}

/// Faces of one object: joined where they meet convexly or smoothly, never across a concave crease nor from one piece of a stack to another.
std::vector<int> join_faces(const Faces& faces, const std::vector<int>& owner, const std::vector<int>& piece_of_point, const Observation& seen) {
  const FaceEdges edges = find_face_edges(seen, faces, owner);
  std::vector<std::pair<std::size_t, std::pair<int, int>>> order;
  for (const auto& [pair, edge] : edges)
    if (edge.joins) order.emplace_back(edge.links(), pair);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<int> object(faces.faces.size());
  std::iota(object.begin(), object.end(), 0);
  std::vector<int> piece_of_object;  // 0 = of none
  for (const Face& face : faces.faces) piece_of_object.push_back(piece_of_point[face.points.front()]);
  for (const auto& [links, pair] : order) {
    const int to = object[pair.first], from = object[pair.second];
    if (to == from) continue;
    const int piece = piece_of_object[to], other = piece_of_object[from];
    if (piece > 0 && other > 0 && piece != other) continue;
    const bool apart = std::any_of(edges.begin(), edges.end(), [&](const auto& entry) {
      const int p = object[entry.first.first], q = object[entry.first.second];
      return entry.second.concave && entry.second.links() >= kFewestEdgeLinks && ((p == to && q == from) || (p == from && q == to));
    });
    if (apart) continue;
    std::replace(object.begin(), object.end(), from, to);
    piece_of_object[to] = std::max(piece, other);
  }
  return object;
}

}  // namespace

std::vector<int> join_surfaces(const Observation& seen, const std::vector<int>& group, const std::vector<int>& piece_of_point) {
  std::vector<int> within(group.size(), -1), object(group.size(), -1);
  for (std::size_t i = 0; i < group.size(); ++i)
    if (group[i] == 0) within[i] = piece_of_point[i];
  Faces faces = grow_faces(seen.points, seen.graph, within, seen.T_world_camera.translation, kFewestFacePoints);
  leave_out_slivers(faces, seen.graph);
  const std::vector<int> owner = nearest_faces(faces, seen.graph, within), joined = join_faces(faces, owner, piece_of_point, seen);
  for (std::size_t i = 0; i < object.size(); ++i)
    if (owner[i] >= 0) object[i] = joined[owner[i]];
  return object;
}

}  // namespace unseen::cuboids
