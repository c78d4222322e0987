// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/cuts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cuboids/boxes/box_axes.h"
#include "cuboids/boxes/box_fit.h"
#include "cuboids/boxes/outline.h"
#include "cuboids/objects/cut_apart.h"
#include "cuboids/objects/groove.h"
#include "cuboids/objects/hollow.h"

namespace unseen::cuboids {
namespace {

constexpr double kHollow = 0.08;         // of a hull's volume: less free space is noise or a rounded edge
constexpr double kHollowStep = 0.02;     // beside a step
constexpr double kLargeFace = 0.05;      // of a part's points
constexpr double kStepSigmas = 5.0;
constexpr double kBeforeFaceSigmas = 3.0;
constexpr double kFlat = 0.9;               // of the points, on sides of boxes
constexpr double kNearlyFlat = 0.8, kLessRest = 1.0 / 3.0;  // the same, where so much less is on none than before the cut: round spines and edges
constexpr double kVeryHollow = 0.25, kMostly = 0.6;         // of a hull; of the points, of pieces that each are a box
constexpr int kFewestFlatPoints = 24;
constexpr std::size_t kFewestShards = 3;
constexpr double kOneWay = 0.7;  // of pieces that lean: books on a shelf
constexpr double kTellingSigmas = 8.0;  // of the second of a box's sides: what is thinner is near its surface in any case
const double kParallelCosine = std::cos(radians(10.0)), kLeaningCosine = std::cos(radians(15.0));

/// Parts the faces that lie along the axes from those that do not, as of a plank that leans on a crate. A face along the axes that borders mostly on
/// ones that are not is of theirs: the narrow side of the plank. What is of no face, or of a sliver along an edge, goes with the nearest.
std::vector<Piece> cut_by_axes(const Observation& seen, const Interior& interior, const std::vector<Face>& faces, const std::vector<int>& points) {
  std::vector<signed char> side(seen.points.size(), 0);
  std::vector<int> owner(seen.points.size(), -2), queue;  // −2 = not of the points
  for (const int i : points) {
    const int face = interior.face_of_point[i];
    owner[i] = face >= 0 && static_cast<double>(faces[face].points.size()) >= fewest_points(points.size()) ? face : -1;
    if (owner[i] >= 0) queue.push_back(i);
  }
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (const int j : seen.graph.neighbours(queue[at]))
      if (owner[j] == -1) owner[j] = owner[queue[at]], queue.push_back(j);
  std::vector<char> along(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) along[f] = is_along(faces[f], interior.axes);
  std::vector<int> balance(faces.size(), 0);  // links to faces along the axes, less those to others
  for (const int i : points)
    for (const int j : seen.graph.neighbours(i))
      if (owner[i] >= 0 && owner[j] >= 0 && owner[i] != owner[j]) balance[owner[i]] += along[owner[j]] ? 1 : -1;
  for (const int i : points)
    if (owner[i] >= 0) side[i] = along[owner[i]] && balance[owner[i]] >= 0 ? 1 : 2;
  std::vector<Piece> pieces = pieces_of_sides(seen, interior, points, side);
  const std::size_t kept = std::accumulate(pieces.begin(), pieces.end(), std::size_t{0}, [](std::size_t sum, const Piece& piece) { return sum + piece.points.size(); });
  if (static_cast<double>(kept) < kKept * static_cast<double>(points.size())) pieces.clear();
  return pieces;
}

/// Planes a little in front of the faces of a part that are large enough to tell.
std::vector<Plane> planes_before(const Observation& seen, const std::vector<const Face*>& faces, std::size_t points) {
  std::vector<Plane> planes;
  for (const Face* face : faces)
    if (static_cast<double>(face->points.size()) > kSmallestPiece * static_cast<double>(points))
      planes.push_back({face->plane.normal, face->plane.offset + kBeforeFaceSigmas * seen.graph.sigma[face->points.front()]});
  return planes;
}

/// Whether two large faces look the same way from different levels, as no box has them: one lies above the other, and that below it. Each of two pieces of
/// a side that bulges lies below the other.
bool has_steps(const Observation& seen, const std::vector<const Face*>& faces, std::size_t points) {
  const auto is_large = [&](const Face* face) { return static_cast<double>(face->points.size()) > kLargeFace * static_cast<double>(points); };
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!is_large(faces[a]) || !is_large(faces[b]) || faces[a]->plane.normal.dot(faces[b]->plane.normal) < kParallelCosine) continue;
      const double rise = faces[a]->plane.signed_distance(faces[b]->center), fall = -faces[b]->plane.signed_distance(faces[a]->center);
      if (rise * fall > 0.0 && std::min(std::abs(rise), std::abs(fall)) > kStepSigmas * seen.graph.sigma[faces[a]->points.front()]) return true;
    }
  return false;
}

/// Faces of groups of points, and the group of each.
struct GroupedFaces {
  Faces faces;
  std::vector<std::vector<const Face*>> of_group;
};

template <typename Groups>
GroupedFaces faces_of(const Observation& seen, const Groups& groups) {
  std::vector<int> group(seen.points.size(), -1);
  for (std::size_t k = 0; k < groups.size(); ++k)
    for (const int i : groups[k].points) group[i] = static_cast<int>(k);
  GroupedFaces result{grow_faces(seen.points, seen.graph, group, seen.T_world_camera.translation, kFewestFlatPoints), {}};
  result.of_group.resize(groups.size());
  for (const Face& face : result.faces.faces) result.of_group[group[face.points.front()]].push_back(&face);
  return result;
}

struct Look {
  Interior interior;
  Piece whole;
};

/// What is within the hull of some points, along the axes of a box around them or as that leans: where less of it is free.
Look look_along(const Observation& seen, const DepthView& view, const std::vector<int>& points, std::span<const int> face_of_point, std::span<const Face* const> faces) {
  const auto along = [&](const Mat3& axes) {
    Interior interior = look_into(seen, view, points, face_of_point, axes);
    Piece whole = piece_of(seen, interior, points);
    return Look{std::move(interior), std::move(whole)};
  };
  const Mat3 axes = box_axes(seen, view, points, faces, false), leaning = leaning_axes(seen, view, faces, axes);
  Look look = along(axes);
  if (leaning == axes) return look;
  Look other = along(leaning);
  return other.whole.hollow.share() < look.whole.hollow.share() ? other : look;
}

/// The faces that have most of their points among some.
std::vector<const Face*> faces_within(const GroupedFaces& faces, std::span<const int> points) {
  std::map<int, std::size_t> counts;
  for (const int i : points)
    if (const int face = faces.faces.face_of_point[i]; face >= 0) ++counts[face];
  std::vector<const Face*> within;
  for (const auto& [id, count] : counts)
    if (2 * count > faces.faces.faces[id].points.size()) within.push_back(&faces.faces.faces[id]);
  return within;
}

/// Share of a piece's points that are sides of a box: of faces along its axes, or near its surface, as of posts too slender to tell their faces.
double explained_by_box(const Observation& seen, const DepthView& view, const Piece& piece, std::span<const Face* const> faces, const Mat3& whole) {
  const Mat3 axes = box_axes(seen, view, piece.points, faces, false);
  const OrientedBox box = bound_along(seen, view, piece.points, faces, axes, whole, 0.0);
  const double by_faces = explained_share(piece.points, faces, axes);
  Vec3 size = 2.0 * box.half_size;
  std::sort(size.begin(), size.end());
  if (size[1] < kTellingSigmas * mean_sigma(seen, piece.points)) return by_faces;
  return std::max(by_faces, share_on_surface(seen, piece.points, box, kNearSurface));
}

/// Whether nearly all of what was seen of the pieces are sides of boxes, or most of it and far more than of the whole, of which `explained_whole` are.
/// Of a whole that is very hollow, most may belong to pieces that each are a box: a shelf with a globe on it.
bool are_boxes(const Observation& seen, const DepthView& view, const std::vector<Piece>& pieces, const Look& look, double explained_whole) {
  const GroupedFaces faces = faces_of(seen, pieces);
  double all = 0, explained = 0, of_boxes = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double count = static_cast<double>(pieces[k].points.size());
    const double share = explained_by_box(seen, view, pieces[k], faces.of_group[k], look.interior.axes);
    all += count;
    explained += count * share;
    if (share >= kFlat) of_boxes += count;
  }
  const double share = explained / all;
  if (look.whole.hollow.share() > kVeryHollow && of_boxes >= kMostly * all) return true;
  return share >= kFlat || (share >= kNearlyFlat && 1.0 - share <= kLessRest * (1.0 - explained_whole));
}

/// Whether more than half of the points of several pieces are of ones that lean from the whole, and that all round: shards of a bowl.
bool are_shards(const Observation& seen, const DepthView& view, const std::vector<Piece>& pieces, const Mat3& whole) {
  if (pieces.size() < kFewestShards) return false;
  const GroupedFaces faces = faces_of(seen, pieces);
  double all = 0, leaning = 0;
  Vec3 leans = Vec3::Zero();  // which way
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double count = static_cast<double>(pieces[k].points.size());
    const Vec3 up = whole.transpose() * box_axes(seen, view, pieces[k].points, faces.of_group[k], false).col(2);
    all += count;
    if (up.cwiseAbs().maxCoeff() > kLeaningCosine) continue;
    leaning += count;
    leans += count * Vec3(up.x(), up.y(), 0).normalized();
  }
  return leaning > 0.5 * all && leans.norm() < kOneWay * leaning;
}

}  // namespace

std::vector<ObjectPart> cut_parts(const Observation& seen, const DepthView& view, std::vector<ObjectPart> parts, Context& context) {
  const GroupedFaces faces = faces_of(seen, parts);
  std::vector<ObjectPart> result;
  int stacks = 0;
  for (const ObjectPart& part : parts) stacks = std::max(stacks, part.stack + 1);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    context.check();
    ObjectPart& part = parts[k];
    const std::size_t first = result.size();
    const auto keep = [&](std::vector<int>&& points) { result.push_back({std::move(points), part.label, part.free_orientation, part.stack, part.level}); };
    const Mat3 axes = box_axes(seen, view, part.points, faces.of_group[k], false);
    std::vector<std::vector<int>> open{part.points};
    if (explained_share(part.points, faces.of_group[k], axes) >= kFlat)  // it looks like one box
      open = cut_at_grooves(seen, view, part.points, bound(seen, view, part.points, faces.of_group[k], axes, 0.0), fewest_points(part.points.size()));
    while (!open.empty()) {
      context.check();
      std::vector<int> points = std::move(open.back());
      open.pop_back();
      const std::vector<const Face*> own = faces_within(faces, points);
      const Look look = look_along(seen, view, points, faces.faces.face_of_point, own);
      const auto& [interior, whole] = look;
      const double hollow = has_steps(seen, own, points.size()) ? kHollowStep : kHollow;
      if (whole.hollow.share() <= hollow) {
        keep(std::move(points));
        continue;
      }
      const double explained = explained_share(points, own, interior.axes);
      std::vector<Piece> pieces = cut_by_axes(seen, interior, faces.faces.faces, points);
      if (saves(whole, pieces) && are_boxes(seen, view, pieces, look, explained)) {
        for (Piece& piece : pieces) open.push_back(std::move(piece.points));
        continue;
      }
      pieces = cut_apart(seen, interior, planes_before(seen, own, points.size()), whole, hollow, context);
      if (pieces.size() < 2 || !are_boxes(seen, view, pieces, look, explained) || are_shards(seen, view, pieces, interior.axes)) keep(std::move(points));
      else
        for (Piece& piece : pieces) keep(std::move(piece.points));
    }
    if (part.label.empty() || result.size() == first + 1) continue;
    for (std::size_t i = first; i < result.size(); ++i) result[i].stack = stacks, result[i].level = static_cast<int>(i - first);  // one object, but not one box
    ++stacks;
  }
  return result;
}

}  // namespace unseen::cuboids
