// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/join_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "cuboids/faces.h"

namespace unseen::cuboids {
namespace {

constexpr int kFewestFacePoints = 30;
constexpr double kSliver = 6.0;     // widths, in noise or spacing
constexpr double kCurved = 30.0;    // degrees that neighbouring pieces of a hollow surface may differ by
constexpr double kUndecided = 0.3;  // fall of whole faces that says too little of their edge
constexpr int kNearLinks = 12;      // from an edge
constexpr std::size_t kFewestBorderLinks = 4;

/// Where two faces meet.
struct Border {
  std::array<std::vector<int>, 2> ends;  ///< points on either side, of the face with the lower number first
  Vec3 place = Vec3::Zero();              ///< middle of the links
  bool concave = false, joins = false;
  std::size_t links() const { return ends[0].size(); }
};

/// Strips as narrow as what a sensor blurs along an edge say nothing of their own: what is next to them gets them.
void leave_out_slivers(Faces& faces, const PointGraph& graph) {
  for (const Face& face : faces.faces) {
    const int i = face.points.front();
    const double blur = std::max(graph.sigma[i], graph.spacing[i]);
    if (face.width * std::sqrt(12.0) > kSliver * blur) continue;
    for (const int j : face.points) faces.face_of_point[j] = -1;
  }
}

/// Every point of the groups that some face can be reached from gets the nearest (in links) face.
std::vector<int> spread(const Faces& faces, const PointGraph& graph, std::span<const int> group) {
  std::vector<int> owner = faces.face_of_point, queue;
  for (int i = 0; i < static_cast<int>(owner.size()); ++i)
    if (owner[i] >= 0) queue.push_back(i);
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (const int j : graph.neighbours(queue[at]))
      if (owner[j] < 0 && group[j] >= 0 && group[j] == group[queue[at]]) {
        owner[j] = owner[queue[at]];
        queue.push_back(j);
      }
  return owner;
}

/// The middle of what of a face lies within some links of the ends of a border's links.
Vec3 middle_near(const Observation& seen, const Faces& faces, int face, const std::vector<int>& ends) {
  std::set<int> visited(ends.begin(), ends.end());
  std::vector<int> queue(visited.begin(), visited.end());
  Vec3 sum = Vec3::Zero();
  int count = 0;
  std::size_t at = 0;
  for (int step = 0; step <= kNearLinks; ++step)
    for (const std::size_t end = queue.size(); at < end; ++at) {
      const int i = queue[at];
      if (faces.face_of_point[i] == face) sum += seen.points[i], ++count;
      for (const int j : seen.graph.neighbours(i))
        if (faces.face_of_point[j] == face && visited.insert(j).second) queue.push_back(j);
    }
  return count > 0 ? Vec3(sum / count) : faces.faces[face].center;
}

/// How far two faces rise before each other, as the sum of two sines: above 0 the edge between them is concave.
double rise_of(const Observation& seen, const Faces& faces, const std::pair<int, int>& pair, const Border& border) {
  const Face &a = faces.faces[pair.first], &b = faces.faces[pair.second];
  const auto rise = [&](const Vec3& middle_a, const Vec3& middle_b) {
    return a.plane.normal.dot((middle_b - border.place).normalized()) + b.plane.normal.dot((middle_a - border.place).normalized());
  };
  // Far from the edge a large face may lie behind the other's plane, and beside it in front.
  if (const double whole = rise(a.center, b.center); whole > 0.0 || whole < -kUndecided) return whole;
  return rise(middle_near(seen, faces, pair.first, border.ends[0]), middle_near(seen, faces, pair.second, border.ends[1]));
}

void judge(const Observation& seen, const Faces& faces, const std::pair<int, int>& pair, Border& border) {
  const Face &a = faces.faces[pair.first], &b = faces.faces[pair.second];
  const double sigma = seen.graph.sigma[a.points.front()], spacing = seen.graph.spacing[a.points.front()];
  const double angle = degrees(std::acos(std::clamp(a.plane.normal.dot(b.plane.normal), -1.0, 1.0)));
  // Edges are measured round.
  const double off = std::max(std::abs(a.plane.signed_distance(border.place)), std::abs(b.plane.signed_distance(border.place)));
  const bool meets = off < 5.0 * sigma + 1.5 * spacing;
  border.concave = angle > kCurved && rise_of(seen, faces, pair, border) > 0.0;
  border.joins = !border.concave && meets && border.links() >= kFewestBorderLinks;
}

/// Faces of one object: joined where they meet convexly or smoothly, never across a concave edge nor from one piece of a stack to another.
std::vector<int> join_faces(const Faces& faces, const std::vector<int>& owner, const std::vector<int>& piece_of_point, const Observation& seen) {
  std::map<std::pair<int, int>, Border> borders;
  for (int i = 0; i < static_cast<int>(owner.size()); ++i)
    for (const int j : seen.graph.neighbours(i)) {
      if (j < i || owner[i] < 0 || owner[j] < 0 || owner[i] == owner[j]) continue;
      Border& border = borders[std::minmax(owner[i], owner[j])];
      border.ends[owner[i] < owner[j] ? 0 : 1].push_back(i);
      border.ends[owner[i] < owner[j] ? 1 : 0].push_back(j);
      border.place += 0.5 * (seen.points[i] + seen.points[j]);
    }
  std::vector<std::pair<std::size_t, std::pair<int, int>>> order;
  for (auto& [pair, border] : borders) {
    border.place /= static_cast<double>(border.links());
    judge(seen, faces, pair, border);
    if (border.joins) order.emplace_back(border.links(), pair);
  }
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
    const bool apart = std::any_of(borders.begin(), borders.end(), [&](const auto& entry) {
      const int p = object[entry.first.first], q = object[entry.first.second];
      return entry.second.concave && entry.second.links() >= kFewestBorderLinks && ((p == to && q == from) || (p == from && q == to));
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
  const std::vector<int> owner = spread(faces, seen.graph, within), joined = join_faces(faces, owner, piece_of_point, seen);
  for (std::size_t i = 0; i < object.size(); ++i)
    if (owner[i] >= 0) object[i] = joined[owner[i]];
  return object;
}

}  // namespace unseen::cuboids
