// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

#include "cuboids/faces.h"
#include "cuboids/observation.h"
#include "cuboids/stack_levels.h"
#include "cuboids/strokes.h"
#include "cuboids/supports.h"

namespace unseen::cuboids {
namespace {

constexpr int kFewestFacePoints = 30;
constexpr std::size_t kFewestObjectPoints = 80;     // of an object
constexpr double kSmallestObject = 0.003;        // of the points of all objects, where nobody says what an object is
constexpr std::size_t kFewPoints = 500;         // so few may be a strip along an edge
constexpr double kStrip = 8.0;                 // widths, in spacing
constexpr double kLowest = 4.0;               // σ above the supports; below, it is speckle of theirs
constexpr double kCurved = 30.0;              // degrees that neighbouring pieces of a hollow surface may differ by
constexpr std::size_t kFewestBorderLinks = 4;
constexpr double kSliver = 6.0;                // widths, in noise or spacing
constexpr double kOutside = 0.02;             // m beyond the outline of the ground, where something else carries

/// Where two faces meet.
struct Border {
  std::size_t links = 0;
  Vec3 place = Vec3::Zero();  ///< sum over links
  bool concave = false, joins = false;
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

void judge(Border& border, const Face& a, const Face& b, double sigma, double spacing) {
  const Vec3 place = border.place / static_cast<double>(border.links);
  const double angle = degrees(std::acos(std::clamp(a.plane.normal.dot(b.plane.normal), -1.0, 1.0)));
  const double rise = a.plane.normal.dot((b.center - place).normalized()) + b.plane.normal.dot((a.center - place).normalized());
  // Edges are measured round.
  const double off = std::max(std::abs(a.plane.signed_distance(place)), std::abs(b.plane.signed_distance(place)));
  const bool meets = off < 5.0 * sigma + 1.5 * spacing;
  border.concave = rise > 0.0 && angle > kCurved;
  border.joins = !border.concave && meets && border.links >= kFewestBorderLinks;
}

/// Faces of one object: joined where they meet convexly or smoothly, never across a concave edge nor from one piece of a stack to another.
std::vector<int> join_faces(const Faces& faces, const std::vector<int>& owner, const std::vector<int>& piece_of_point, const Observation& seen) {
  std::map<std::pair<int, int>, Border> borders;
  for (int i = 0; i < static_cast<int>(owner.size()); ++i)
    for (const int j : seen.graph.neighbours(i)) {
      if (j < i || owner[i] < 0 || owner[j] < 0 || owner[i] == owner[j]) continue;
      Border& border = borders[std::minmax(owner[i], owner[j])];
      ++border.links;
      border.place += 0.5 * (seen.points[i] + seen.points[j]);
    }
  std::vector<std::pair<std::size_t, std::pair<int, int>>> order;
  for (auto& [pair, border] : borders) {
    const Face &a = faces.faces[pair.first], &b = faces.faces[pair.second];
    judge(border, a, b, seen.graph.sigma[a.points.front()], seen.graph.spacing[a.points.front()]);
    if (border.joins) order.emplace_back(border.links, pair);
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
      return entry.second.concave && entry.second.links >= kFewestBorderLinks && ((p == to && q == from) || (p == from && q == to));
    });
    if (apart) continue;
    std::replace(object.begin(), object.end(), from, to);
    piece_of_object[to] = std::max(piece, other);
  }
  return object;
}

/// The surfaces themselves say where one object ends and the next begins: numbers of objects of the points of group 0, −1 = none.
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

/// Points of equal non-negative group that links connect.
std::vector<std::vector<int>> components(const Observation& seen, const std::vector<int>& group) {
  std::vector<std::vector<int>> parts;
  std::vector<char> done(group.size(), 0);
  for (int s = 0; s < static_cast<int>(group.size()); ++s) {
    if (group[s] < 0 || done[s]) continue;
    std::vector<int> part{s};
    done[s] = 1;
    for (std::size_t at = 0; at < part.size(); ++at)
      for (const int j : seen.graph.neighbours(part[at]))
        if (!done[j] && group[j] == group[s]) done[j] = 1, part.push_back(j);
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Which points may belong to objects: not of a support, not below the ground. What lies beyond the ground's end is carried by something else,
/// or hangs over, with most of it above the ground.
std::vector<int> candidates(const Observation& seen) {
  std::vector<int> group(seen.points.size(), -1);
  std::vector<Vec2> outline;
  for (const Vec3& p : seen.supports.front().outline) outline.push_back(p.head<2>());
  std::vector<char> beyond(seen.points.size(), 0);
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const Vec3& p = seen.points[i];
    if (seen.support_of_point[i] >= 0 || seen.supports.front().plane.signed_distance(p) < 0.0) continue;
    beyond[i] = !outline.empty() && !inside_outline(outline, p.head<2>(), kOutside);
    const bool behind = std::any_of(seen.supports.begin() + 1, seen.supports.end(), [&](const Support& s) {
      return s.kind == SupportKind::wall && s.plane.signed_distance(p) < -4.0 * seen.graph.sigma[i] && s.plane.signed_distance(p) > -0.1;
    });
    if (!behind) group[i] = 0;
  }
  if (outline.empty()) return group;
  for (const std::vector<int>& part : components(seen, group)) {
    const auto out = std::count_if(part.begin(), part.end(), [&](int i) { return beyond[i] != 0; });
    if (2 * static_cast<std::size_t>(out) < part.size()) continue;
    for (const int i : part)
      if (beyond[i] != 0) group[i] = -1;
  }
  return group;
}

/// Too few points, or no farther from the supports than their own noise.
bool is_debris(const Observation& seen, const std::vector<int>& part, std::size_t fewest) {
  if (part.size() < fewest) return true;
  if (part.size() < kFewPoints) {
    Vec3 mean = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const int i : part) mean += seen.points[i] / static_cast<double>(part.size());
    for (const int i : part) second += (seen.points[i] - mean) * (seen.points[i] - mean).transpose() / static_cast<double>(part.size());
    const double width = std::sqrt(12.0 * std::max(Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvalues()[1], 0.0));
    if (width < kStrip * seen.graph.spacing[part.front()]) return true;
  }
  for (const Support& support : seen.supports) {
    std::vector<double> height;
    for (const int i : part) height.push_back(support.plane.signed_distance(seen.points[i]) / seen.graph.sigma[i]);
    const auto high = height.begin() + static_cast<std::ptrdiff_t>(height.size() * 9 / 10);
    std::nth_element(height.begin(), high, height.end());
    if (std::abs(*high) < kLowest) return true;
  }
  return false;
}

}  // namespace

std::vector<ObjectPart> find_objects(const RgbdFrame& frame, const Observation& seen, const Options&, Context& context) {
  std::vector<int> group = candidates(seen);
  std::vector<std::string> labels;
  const bool drawn = !frame.strokes.empty() && !frame.is_fused(), masked = !frame.masks.empty() && !frame.is_fused();
  if (drawn) {
    const std::vector<int> object = cut_by_strokes(frame, seen);
    labels = stroke_labels(frame);
    for (std::size_t i = 0; i < group.size(); ++i)
      group[i] = group[i] < 0 ? -1 : object[seen.pixel_of_point[i]] + 1;  // 0 = the rest
  } else if (masked) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int mask = frame.masks[seen.pixel_of_point[i]];
      group[i] = mask > 0 && seen.support_of_point[i] < 0 ? mask : -1;
    }
  }
  context.check();
  std::vector<int> object = group;
  Stacks stacks = no_stacks(seen);
  if (!masked) {
    std::vector<int> joined = join_surfaces(seen, group, stacks.piece_of_point);
    if (!frame.is_fused()) stacks = find_stacks(seen, components(seen, joined), context);
    if (stacks.stack_of_piece.size() > 1) joined = join_surfaces(seen, group, stacks.piece_of_point);
    const int first = static_cast<int>(labels.size()) + 2;
    for (std::size_t i = 0; i < object.size(); ++i)
      if (group[i] == 0 && joined[i] >= 0) object[i] = first + joined[i];
  }
  context.check();
  std::vector<ObjectPart> parts;
  std::size_t debris = 0;
  std::vector<std::vector<int>> pieces = components(seen, object);
  const std::size_t total = std::accumulate(pieces.begin(), pieces.end(), std::size_t{0}, [](std::size_t n, const auto& p) { return n + p.size(); });
  const std::size_t fewest = std::max(kFewestObjectPoints, masked || drawn ? 0 : static_cast<std::size_t>(kSmallestObject * static_cast<double>(total)));
  for (std::vector<int>& points : pieces) {
    if (is_debris(seen, points, fewest)) {
      ++debris;
      continue;
    }
    ObjectPart part;
    const int g = group[points.front()];
    if (masked) part.label = std::to_string(g);
    if (drawn && g > 0) {
      part.label = labels[g - 1];
      part.free_orientation = true;
    }
    for (const int i : points) part.level = std::max(part.level, stacks.piece_of_point[i]);
    part.stack = stacks.stack_of_piece[part.level];
    part.points = std::move(points);
    parts.push_back(std::move(part));
  }
  if (debris > 0) context.message(fmt::format("{} pieces too small to be objects were left out", debris));
  return parts;
}

}  // namespace unseen::cuboids
