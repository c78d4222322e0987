// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/face_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/linear.h"

namespace unseen::cuboids {
namespace {

constexpr double kCurved = 30.0;    // degrees that neighbouring pieces of a hollow surface may differ by
constexpr double kUndecided = 0.3;  // fall of whole faces that says too little of their edge
constexpr int kNearLinks = 12;      // from an edge
constexpr int kFarLinks = 30;       // … where a crease and a hollow are told apart
constexpr std::size_t kFewestNear = 60;  // points on either side
constexpr double kBlunt = 60.0;     // degrees between normals
constexpr double kWorse = 1.2;      // mean distance to a paraboloid, of that to two planes

/// What of a face lies within `reach` links of the ends of an edge's links.
std::vector<int> part_near(const Observation& seen, const Faces& faces, int face, const std::vector<int>& ends, int reach) {
  std::vector<char> visited(faces.face_of_point.size(), 0);
  std::vector<int> queue, part;
  for (const int i : ends)
    if (std::exchange(visited[i], 1) == 0) queue.push_back(i);
  std::size_t at = 0;
  for (int step = 0; step <= reach; ++step)
    for (const std::size_t end = queue.size(); at < end; ++at) {
      const int i = queue[at];
      if (faces.face_of_point[i] == face) part.push_back(i);
      for (const int j : seen.graph.neighbours(i))
        if (faces.face_of_point[j] == face && std::exchange(visited[j], 1) == 0) queue.push_back(j);
    }
  return part;
}

Vec3 middle_of(const Observation& seen, const std::vector<int>& part, const Vec3& otherwise) {
  Vec3 sum = Vec3::Zero();
  for (const int i : part) sum += seen.points[i];
  return part.empty() ? otherwise : Vec3(sum / static_cast<double>(part.size()));
}

/// Sum of the squared distances of points to their plane, in σ.
double squares_to_plane(const Observation& seen, const std::vector<int>& part) {
  const Vec3 middle = middle_of(seen, part, Vec3::Zero());
  Mat3 second = Mat3::Zero();
  for (const int i : part) {
    const Vec3 d = (seen.points[i] - middle) / seen.graph.sigma[i];
    second += d * d.transpose();
  }
  return symmetric_eigen(second).values[0];
}

/// Sum of the squared distances of points to the paraboloid about `axis` that fits them, in σ.
double squares_to_paraboloid(const Observation& seen, const std::array<std::vector<int>, 2>& parts, const Vec3& origin, const Vec3& axis) {
  const Vec3 u = any_orthogonal(axis), v = axis.cross(u);
  Eigen::Matrix<double, Eigen::Dynamic, 6> terms(parts[0].size() + parts[1].size(), 6);
  Eigen::VectorXd height(terms.rows());
  Eigen::Index row = 0;
  for (const std::vector<int>& part : parts)
    for (const int i : part) {
      const Vec3 d = seen.points[i] - origin;
      const double x = d.dot(u), y = d.dot(v), sigma = seen.graph.sigma[i];
      terms.row(row) << 1.0, x, y, x * x, x * y, y * y;
      terms.row(row) /= sigma;
      height[row++] = d.dot(axis) / sigma;
    }
  const Eigen::Vector<double, 6> c = least_squares(terms, height);
  double sum = 0;
  for (row = 0; row < terms.rows(); ++row) {
    const double x = terms(row, 1) / terms(row, 0), y = terms(row, 2) / terms(row, 0);
    const Vec2 slope(c[1] + 2.0 * c[3] * x + c[4] * y, c[2] + c[4] * x + 2.0 * c[5] * y);
    const double above = terms.row(row).dot(c) - height[row];
    sum += above * above / (1.0 + slope.squaredNorm());
  }
  return sum;
}

/// Whether what lies near the edge of two faces is one hollow surface (of a bowl, say) that was taken for flat pieces: a paraboloid, which has as many
/// unknowns as two planes, explains it nearly as well. Things at rest beside each other seldom enclose a blunt angle: there the planes must do clearly better.
bool is_smooth(const Observation& seen, const std::array<std::vector<int>, 2>& near, const Vec3& place, const Vec3& normal_a, const Vec3& normal_b) {
  if (std::min(near[0].size(), near[1].size()) < kFewestNear) return false;
  const bool blunt = normal_a.dot(normal_b) > std::cos(radians(kBlunt));
  const double worse = blunt ? kWorse * kWorse : 1.0;
  return squares_to_paraboloid(seen, near, place, (normal_a + normal_b).normalized()) < worse * (squares_to_plane(seen, near[0]) + squares_to_plane(seen, near[1]));
}

void judge(const Observation& seen, const Faces& faces, const std::pair<int, int>& pair, FaceEdge& edge) {
  const Face &a = faces.faces[pair.first], &b = faces.faces[pair.second];
  const double sigma = seen.graph.sigma[a.points.front()], spacing = seen.graph.spacing[a.points.front()];
  const double angle = degrees(std::acos(std::clamp(a.plane.normal.dot(b.plane.normal), -1.0, 1.0)));
  // Edges are measured round.
  const double off = std::max(std::abs(a.plane.signed_distance(edge.place)), std::abs(b.plane.signed_distance(edge.place)));
  const bool meets = off < 5.0 * sigma + 1.5 * spacing;
  const auto near = [&](int reach) {
    return std::array{part_near(seen, faces, pair.first, edge.ends[0], reach), part_near(seen, faces, pair.second, edge.ends[1], reach)};
  };
  // How far either rises before the other, as the sum of two sines: above 0 the edge is concave.
  const auto rise = [&](const Vec3& middle_a, const Vec3& middle_b) {
    return a.plane.normal.dot((middle_b - edge.place).normalized()) + b.plane.normal.dot((middle_a - edge.place).normalized());
  };
  double up = rise(a.center, b.center);
  // Far from the edge a large face may lie behind the other's plane, and beside it in front.
  if (up <= 0.0 && up >= -kUndecided) {
    const auto parts = near(kNearLinks);
    up = rise(middle_of(seen, parts[0], a.center), middle_of(seen, parts[1], b.center));
  }
  edge.concave = angle > kCurved && up > 0.0 && !is_smooth(seen, near(kFarLinks), edge.place, a.plane.normal, b.plane.normal);
  edge.joins = !edge.concave && meets && edge.links() >= kFewestEdgeLinks;
}

}  // namespace

std::vector<int> nearest_faces(const Faces& faces, const PointGraph& graph, std::span<const int> group) {
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

FaceEdges find_face_edges(const Observation& seen, const Faces& faces, std::span<const int> owner) {
  FaceEdges edges;
  for (int i = 0; i < static_cast<int>(owner.size()); ++i)
    for (const int j : seen.graph.neighbours(i)) {
      if (j < i || owner[i] < 0 || owner[j] < 0 || owner[i] == owner[j]) continue;
      FaceEdge& edge = edges[std::minmax(owner[i], owner[j])];
      edge.ends[owner[i] < owner[j] ? 0 : 1].push_back(i);
      edge.ends[owner[i] < owner[j] ? 1 : 0].push_back(j);
      edge.place += 0.5 * (seen.points[i] + seen.points[j]);
    }
  for (auto& [pair, edge] : edges) {
    edge.place /= static_cast<double>(edge.links());
    judge(seen, faces, pair, edge);
  }
  return edges;
}

}  // namespace unseen::cuboids
