// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cuboids/surfaces/supports.h"

namespace unseen::cuboids {
namespace {

constexpr double kDown = 0.9, kForward = 0.43;  // of a camera held upright, looking a little down: its usual up is (0, −0.9, −0.43)
const Vec3 kUsualUp = Vec3(0.0, -kDown, -kForward).normalized();
constexpr std::size_t kMostFaces = 40;
constexpr double kLargeShare = 0.2;   // of the area of the largest plane
constexpr double kFewestPoints = 60;  // of a piece
constexpr int kFewestLinks = 8;       // between a piece and what it stands on
constexpr double kOff = 6.0;          // σ from every plane
constexpr double kCarriesMost = 0.6;  // of the points of all pieces
constexpr double kClearlyMore = 1.5;  // evidence that it takes to turn a picture
constexpr double kFills = 0.5, kFillsWithinSides = 0.3, kHardlyAny = 0.05;  // of a picture
constexpr double kSeldom = 0.25;      // evidence counts so much of a picture that is upside down or aslant; portrait is usual
constexpr double kUnder = 0.03, kHardlyAnyUnder = 0.002;  // m below a floor; share of all points that may be
constexpr double kOpposite = 0.25;    // of a floor's points: as much facing it is another wall of a bin …
constexpr double kWidestBin = 1.5;    // m, … and lower than any room
const double kTurned = radians(60.0), kPortrait = radians(25.0), kSteep = std::sin(radians(30.0)), kStraight = std::cos(radians(20.0));

/// Connected points beside the large planes, and how it is linked to each of them.
struct Piece {
  double points = 0;       ///< those that are clearly off every plane
  std::vector<int> links;  ///< one number a plane
};

std::vector<int> largest_faces(const Scan& scan) {
  std::vector<int> large(scan.faces.faces.size());
  for (std::size_t f = 0; f < large.size(); ++f) large[f] = static_cast<int>(f);
  std::stable_sort(large.begin(), large.end(),
                   [&](int a, int b) { return scan.faces.faces[a].area > scan.faces.faces[b].area; });
  if (large.size() > kMostFaces) large.resize(kMostFaces);
  return large;
}

/// The direction that most large faces agree is up in a picture that was taken upright or looking down.
Vec3 usual_up(const Scan& scan, const std::vector<int>& large) {
  Vec3 best = Vec3::Zero();
  double best_score = 0;
  for (const int c : large) {
    const Face& candidate = scan.faces.faces[c];
    const Vec3& up = candidate.plane.normal;
    const double usual = scan.is_image ? std::max(up.dot(kUsualUp), 0.0) : 0.5 + 0.5 * up.z();
    double agree = 0;
    for (const int f : large) {
      const Face& face = scan.faces.faces[f];
      const double cosine = std::abs(face.plane.normal.dot(up));
      agree += cosine > kHorizontal ? face.area : cosine < kVertical ? 0.3 * face.area : 0.0;
    }
    const double score = std::pow(usual, 4) * (agree + candidate.area);
    if (score > best_score) best_score = score, best = up;
  }
  return best;
}

/// The large planes, and all that face `up`.
std::vector<Level> large_or_facing(std::vector<Level> levels, const Vec3& up) {
  double most = 0;
  for (const Level& level : levels) most = std::max(most, level.area);
  std::erase_if(levels, [&](const Level& level) {
    return level.area < kLargeShare * most && level.plane.normal.dot(up) < kHorizontal;
  });
  return levels;
}

/// One piece, from a point of it; marks its points.
Piece piece_from(const Scan& scan, const std::vector<Level>& levels, const std::vector<int>& level_of, int first, std::vector<char>& done) {
  Piece piece{0, std::vector<int>(levels.size(), 0)};
  std::vector<int> queue{first};
  done[first] = 1;
  for (std::size_t at = 0; at < queue.size(); ++at) {
    const int i = queue[at];
    piece.points += std::all_of(levels.begin(), levels.end(), [&](const Level& level) {
      return std::abs(level.plane.signed_distance(scan.points[i])) > kOff * scan.graph.sigma[i];
    });
    for (const int j : scan.graph.neighbours(i)) {
      if (level_of[j] >= 0) ++piece.links[level_of[j]];
      if (level_of[j] < 0 && !done[j]) done[j] = 1, queue.push_back(j);
    }
  }
  return piece;
}

/// What is beside the planes and is linked to one of them.
std::vector<Piece> find_pieces(const Scan& scan, const std::vector<Level>& levels) {
  std::vector<int> level_of(scan.points.size(), -1);
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (const int i : points_of(scan, levels[k].faces)) level_of[i] = static_cast<int>(k);
  std::vector<Piece> pieces;
  std::vector<char> done(scan.points.size(), 0);
  for (int i = 0; i < static_cast<int>(done.size()); ++i) {
    if (done[i] || level_of[i] >= 0) continue;
    Piece piece = piece_from(scan, levels, level_of, i, done);
    const bool linked = std::any_of(piece.links.begin(), piece.links.end(), [](int n) { return n >= kFewestLinks; });
    if (linked && piece.points >= kFewestPoints) pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Share of the pieces, by points, that start from a plane which faces `up`. All that stands does so from its ground;
/// from a wall only what was put against it. None if there are no pieces.
std::optional<double> carried_share(const Scan& scan, const std::vector<Level>& planes, const Vec3& up) {
  const std::vector<Level> levels = large_or_facing(planes, up);
  double all = 0, carried = 0;
  for (const Piece& piece : find_pieces(scan, levels)) {
    int links = 0;
    for (std::size_t k = 0; k < levels.size(); ++k)
      if (levels[k].plane.normal.dot(up) > kHorizontal) links += piece.links[k];
    all += piece.points;
    if (links >= kFewestLinks) carried += piece.points;
  }
  return all > 0.0 ? std::optional(carried / all) : std::nullopt;
}

/// About its axis, rad; 0 = upright.
double turn_of(const Vec3& up) { return std::abs(std::atan2(up.x(), -up.y())); }

/// m²: what faces `up`, the less the more the camera would look at a wall as nobody looks at a floor, whatever it is turned
/// by about its axis, and the less stands on it.
double evidence(const Scan& scan, const std::vector<int>& large, const Vec3& up, double share) {
  double area = 0;
  for (const int f : large)
    if (scan.faces.faces[f].plane.normal.dot(up) > kHorizontal) area += scan.faces.faces[f].area;
  const double pitch = (kDown * up.head<2>().norm() - kForward * up.z()) / std::hypot(kDown, kForward);
  const double often = is_turned(up) && std::abs(turn_of(up) - 0.5 * kPi) > kPortrait ? kSeldom : 1.0;
  return std::pow(std::max(pitch, 0.0) * share, 4) * area * often;
}

double points_on(const Scan& scan, const Level& level) {
  double count = 0;
  for (const int f : level.faces) count += static_cast<double>(scan.faces.faces[f].points.size());
  return count;
}

double points_facing(const Scan& scan, const std::vector<Level>& planes, const Vec3& direction) {
  double count = 0;
  for (const Level& level : planes)
    if (level.plane.normal.dot(direction) > kHorizontal) count += points_on(scan, level);
  return count;
}

/// Whether what faces `side` and what faces it are as large, and nearer to each other than floor and ceiling.
bool are_sides_of_bin(const Scan& scan, const std::vector<Level>& planes, const Vec3& side) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Level& one : planes)
    for (const Level& other : planes) {
      if (one.plane.normal.dot(side) < kHorizontal || other.plane.normal.dot(side) > -kHorizontal) continue;
      if (const double between = -(one.plane.offset + other.plane.offset); between > 0.0) nearest = std::min(nearest, between);
    }
  const double one = points_facing(scan, planes, side), other = points_facing(scan, planes, -side);
  return nearest < kWidestBin && std::min(one, other) > kOpposite * std::max(one, other);
}

/// Whether a camera looks straight at what fills so much of its picture, as at a floor from above.
bool fills_the_picture(const Scan& scan, const Vec3& normal, double points, double share) {
  return normal.z() < -kStraight && points >= share * static_cast<double>(scan.points.size());
}

/// Whether the camera looks straight at the bottom of a bin, or at the back of a shelf, between its four sides.
bool looks_into_bin(const Scan& scan, const std::vector<Level>& planes, const Vec3& side) {
  return are_sides_of_bin(scan, planes, side) && std::any_of(planes.begin(), planes.end(), [&](const Level& level) {
    const Vec3& n = level.plane.normal;
    return std::abs(n.dot(side)) < kVertical && fills_the_picture(scan, n, points_facing(scan, planes, n), kFillsWithinSides) &&
           are_sides_of_bin(scan, planes, n.cross(side).normalized());
  });
}

/// Whether what faces `up` is a floor, of which a level camera may see but a strip: nearly nothing lies below it, nor above it a lid or another side of a
/// bin that is seen from above.
bool is_below_all(const Scan& scan, const std::vector<Level>& planes, const Vec3& up) {
  const Level* floor = nullptr;
  for (const Level& level : planes)
    if (level.plane.normal.dot(up) > kHorizontal && (!floor || points_on(scan, level) > points_on(scan, *floor))) floor = &level;
  if (!floor || points_facing(scan, planes, -up) > kOpposite * points_on(scan, *floor)) return false;
  const auto below = std::count_if(scan.points.begin(), scan.points.end(), [&](const Vec3& p) { return floor->plane.signed_distance(p) < -kUnder; });
  return static_cast<double>(below) < kHardlyAnyUnder * static_cast<double>(scan.points.size());
}

}  // namespace

bool is_turned(const Vec3& up) {
  return up.head<2>().norm() > kSteep && turn_of(up) > kTurned;
}

FoundUp find_up(const Scan& scan) {
  const std::vector<int> large = largest_faces(scan);
  FoundUp found{usual_up(scan, large)};
  if (!scan.is_image) return found;
  const Vec3 usual = found.up;
  const std::vector<Level> planes = coplanar(scan, large);
  if (usual.isZero()) {  // no plane faces up in a picture that is upright
    double most = 0;
    for (const Level& level : planes)
      if (const double told = evidence(scan, large, level.plane.normal, 1.0); told > most) most = told, found.up = level.plane.normal;
    return found;
  }
  const double usual_evidence = evidence(scan, large, usual, carried_share(scan, planes, usual).value_or(1.0));
  double most = usual_evidence;
  found.ambiguous = looks_into_bin(scan, planes, usual);
  const double hardly_any = kHardlyAny * static_cast<double>(scan.points.size());
  for (const Level& level : large_or_facing(planes, usual)) {
    const Vec3& up = level.plane.normal;
    const bool straight = points_facing(scan, planes, usual) < hardly_any && fills_the_picture(scan, up, points_on(scan, level), kFills);
    if (!(is_turned(up) || straight) || up.dot(usual) > kHorizontal || evidence(scan, large, up, 1.0) <= most) continue;
    const double share = carried_share(scan, planes, up).value_or(straight ? 1.0 : 0.0), told = evidence(scan, large, up, share);
    if (share < kCarriesMost || told <= most) continue;
    most = told;
    found.ambiguous = told < kClearlyMore * usual_evidence || (straight && usual_evidence > 0.0 && is_below_all(scan, planes, usual));
    found.up = found.ambiguous ? usual : up;
  }
  return found;
}

}  // namespace unseen::cuboids
