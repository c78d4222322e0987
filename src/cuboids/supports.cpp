// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/supports.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace unseen::cuboids {
namespace {

const double kHorizontal = std::cos(radians(10.0)), kVertical = std::sin(radians(10.0));
const Vec3 kUsualUp = Vec3(0.0, -0.9, -0.43).normalized();  // of a camera held upright, looking a little down
constexpr double kSmallestGroundShare = 0.2;  // of the largest horizontal area, or of its pixels
constexpr double kCarryShare = 1.0 / 3.0;     // of what the surface that carries most carries
constexpr double kCarryHeight = 0.5;          // m
constexpr double kWallShare = 0.25;           // of the square of the scene's radius
constexpr double kMostBehindWall = 0.03;      // of the points
constexpr double kDeskArea = 0.4;  // m²; what is flat and as large may carry things itself
constexpr double kBelow = 0.1, kBelowShare = 0.05;  // m below the ground, share of the points
constexpr int kColumns = 512;
constexpr std::size_t kMostFitPoints = 15000;

struct Level {
  Plane plane;
  double area = 0, carried = 0;
  std::vector<int> faces;
  std::vector<Vec2> outline;
};

std::vector<int> points_of(const Scan& scan, const std::vector<int>& faces) {
  std::vector<int> points;
  for (const int f : faces)
    points.insert(points.end(), scan.faces.faces[f].points.begin(), scan.faces.faces[f].points.end());
  return points;
}

/// m: how far a point may lie from a support that it belongs to.
double tolerance_at(const Scan& scan, const Face& face) {
  return 4.0 * scan.graph.sigma[face.points[face.points.size() / 2]];
}

/// Faces of one plane, largest first; each face joins the first plane that it lies on.
std::vector<Level> coplanar(const Scan& scan, std::vector<int> faces) {
  std::stable_sort(faces.begin(), faces.end(),
                   [&](int a, int b) { return scan.faces.faces[a].area > scan.faces.faces[b].area; });
  std::vector<Level> levels;
  for (const int f : faces) {
    const Face& face = scan.faces.faces[f];
    auto level = std::find_if(levels.begin(), levels.end(), [&](const Level& l) {
      return l.plane.normal.dot(face.plane.normal) > kHorizontal &&
             std::abs(l.plane.signed_distance(face.center)) < std::max(tolerance_at(scan, face), 0.005);
    });
    if (level == levels.end()) level = levels.insert(level, Level{face.plane, 0, 0, {}, {}});
    level->faces.push_back(f);
    level->area += face.area;
  }
  for (Level& level : levels) level.plane = fit_support(scan, points_of(scan, level.faces));
  return levels;
}

void set_outline(const Scan& scan, Level& level, const Vec3& u, const Vec3& v) {
  std::vector<Vec2> flat;
  for (const int f : level.faces)
    for (const int i : scan.faces.faces[f].points) flat.emplace_back(u.dot(scan.points[i]), v.dot(scan.points[i]));
  // Only the lowest and highest point of each thin column can be corners.
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2& p : flat) low = std::min(low, p.x()), high = std::max(high, p.x());
  std::vector<Vec2> lowest(kColumns, Vec2(0, 1e30)), highest(kColumns, Vec2(0, -1e30)), corners;
  for (const Vec2& p : flat) {
    const int c = std::min(static_cast<int>((p.x() - low) / std::max(high - low, 1e-9) * kColumns), kColumns - 1);
    if (p.y() < lowest[c].y()) lowest[c] = p;
    if (p.y() > highest[c].y()) highest[c] = p;
  }
  for (int c = 0; c < kColumns; ++c)
    if (lowest[c].y() < 1e30) corners.insert(corners.end(), {lowest[c], highest[c]});
  level.outline = convex_outline(std::move(corners));
}

/// Points that stand on each level: it is the highest below them, and they are on no level themselves. They are counted as the
/// camera sees them: what it was pointed at matters, not what looms behind.
void weigh_levels(const Scan& scan, std::vector<Level>& levels, const Vec3& u, const Vec3& v) {
  std::vector<char> flat(scan.faces.faces.size(), 0);
  for (const Level& level : levels)
    if (level.area >= kDeskArea)
      for (const int f : level.faces) flat[f] = 1;
  for (std::size_t i = 0; i < scan.points.size(); i += 3) {
    const int f = scan.faces.face_of_point[i];
    if (f >= 0 && flat[f]) continue;
    const Vec2 place(u.dot(scan.points[i]), v.dot(scan.points[i]));
    Level* carrier = nullptr;  // the highest that is below
    double least = kCarryHeight;
    for (Level& level : levels) {
      const double height = level.plane.signed_distance(scan.points[i]);
      if (height > 6.0 * scan.graph.sigma[i] && height < least && inside_outline(level.outline, place, 0.0)) {
        least = height;
        carrier = &level;
      }
    }
    if (carrier) carrier->carried += 1.0;
  }
}

double scene_radius(const Scan& scan) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : scan.points) mean += p;
  mean /= static_cast<double>(scan.points.size());
  std::vector<double> distance;
  for (std::size_t i = 0; i < scan.points.size(); i += 7) distance.push_back((scan.points[i] - mean).norm());
  const auto at = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() * 9 / 10);
  std::nth_element(distance.begin(), at, distance.end());
  return *at;
}

/// Whether (almost) nothing was seen behind a plane within its outline.
bool bounds_the_scene(const Scan& scan, const Level& level, const Vec3& u, const Vec3& v) {
  std::size_t behind = 0, before = 0;
  for (std::size_t i = 0; i < scan.points.size(); i += 5) {
    const double d = level.plane.signed_distance(scan.points[i]);
    if (std::abs(d) < 6.0 * scan.graph.sigma[i]) continue;
    const Vec2 place(u.dot(scan.points[i]), v.dot(scan.points[i]));
    if (!inside_outline(level.outline, place, 0.0)) continue;
    ++(d < 0 ? behind : before);
  }
  return static_cast<double>(behind) <= kMostBehindWall * static_cast<double>(behind + before);
}

std::vector<Vec3> lifted(const Level& level, const Vec3& u, const Vec3& v) {
  std::vector<Vec3> outline;
  for (const Vec2& p : level.outline) outline.push_back(level.plane.project(p.x() * u + p.y() * v));
  return outline;
}

void add_support(FoundSupports& found, const Scan& scan, const Level& level, SupportKind kind, std::vector<Vec3> outline) {
  Support support;
  support.id = static_cast<int>(found.supports.size());
  support.kind = kind;
  support.plane = level.plane;
  support.outline = std::move(outline);
  found.supports.push_back(std::move(support));
  found.points.push_back(points_of(scan, level.faces));
}

}  // namespace

std::vector<Vec2> convex_outline(std::vector<Vec2> points) {
  const auto less = [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull(2 * points.size());
  std::size_t k = 0;
  const auto push = [&](const Vec2& p, std::size_t base) {
    while (k >= base + 2) {
      const Vec2 a = hull[k - 1] - hull[k - 2], b = p - hull[k - 2];
      if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
      --k;
    }
    hull[k++] = p;
  };
  for (const Vec2& p : points) push(p, 0);
  const std::size_t base = k - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) push(points[i], base);
  hull.resize(k - 1);
  return hull;
}

bool inside_outline(std::span<const Vec2> outline, const Vec2& p, double margin) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i], d = p - outline[i];
    if (edge.x() * d.y() - edge.y() * d.x() < -margin * edge.norm()) return false;
  }
  return !outline.empty();
}

Vec3 find_up(const Scan& scan) {
  std::vector<const Face*> large;
  for (const Face& face : scan.faces.faces) large.push_back(&face);
  std::stable_sort(large.begin(), large.end(), [](const Face* a, const Face* b) { return a->area > b->area; });
  if (large.size() > 40) large.resize(40);
  Vec3 best = Vec3::Zero();
  double best_score = 0;
  for (const Face* candidate : large) {
    const Vec3& up = candidate->plane.normal;
    const double usual = scan.is_image ? std::max(up.dot(kUsualUp), 0.0) : 0.5 + 0.5 * up.z();
    double agree = 0;
    for (const Face* face : large) {
      const double c = std::abs(face->plane.normal.dot(up));
      agree += c > kHorizontal ? face->area : c < kVertical ? 0.3 * face->area : 0.0;
    }
    const double score = std::pow(usual, 4) * (agree + candidate->area);
    if (score > best_score) best_score = score, best = up;
  }
  return best;
}

Plane fit_support(const Scan& scan, std::span<const int> points) {
  const std::size_t step = points.size() / kMostFitPoints + 1;
  Vec3 solution = Vec3::Zero();
  Plane plane;
  double scale = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    Mat3 normal_matrix = Mat3::Zero();
    Vec3 right = Vec3::Zero(), mean = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    double weights = 0;
    std::vector<double> residuals;
    const Vec3 origin = scan.points[points[0]];
    for (std::size_t k = 0; k < points.size(); k += step) {
      const Vec3& p = scan.points[points[k]];
      const double w = 1.0 / (double(scan.graph.sigma[points[k]]) * scan.graph.sigma[points[k]]);
      const Vec3 ray = p / p.z();
      const double r = round == 0 ? 0.0
                       : scan.is_image ? std::abs(ray.dot(solution) - 1.0 / p.z())
                                       : std::abs(plane.signed_distance(p)) * std::sqrt(w);
      residuals.push_back(r);
      if (r > 3.0 * scale) continue;
      normal_matrix += ray * ray.transpose();
      right += ray / p.z();
      const Vec3 d = p - origin;
      mean += w * d;
      second += w * d * d.transpose();
      weights += w;
    }
    if (scan.is_image) {
      solution = normal_matrix.ldlt().solve(right);
      plane = {-solution.normalized(), -1.0 / solution.norm()};
    } else {
      mean /= weights;
      const Eigen::SelfAdjointEigenSolver<Mat3> eigen(second / weights - mean * mean.transpose());
      Vec3 n = eigen.eigenvectors().col(0);
      if (n.dot(origin + mean) > 0.0) n = -n;
      plane = {n, n.dot(origin + mean)};
    }
    if (round > 0) {
      const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
      std::nth_element(residuals.begin(), middle, residuals.end());
      scale = 1.4826 * *middle;
    }
  }
  return plane;
}

FoundSupports find_supports(const Scan& scan, const Vec3& up) {
  FoundSupports found;
  found.up = up;
  std::vector<int> upward, downward, upright;
  for (int f = 0; f < static_cast<int>(scan.faces.faces.size()); ++f) {
    const double c = scan.faces.faces[f].plane.normal.dot(up);
    if (c > kHorizontal) upward.push_back(f);
    if (c < -kHorizontal) downward.push_back(f);
    if (std::abs(c) < kVertical) upright.push_back(f);
  }
  std::vector<Level> levels = coplanar(scan, upward);
  const auto area = [&](const std::vector<int>& faces) {
    return std::accumulate(faces.begin(), faces.end(), 0.0, [&](double s, int f) { return s + scan.faces.faces[f].area; });
  };
  found.upside_down = area(downward) > 3.0 * area(upward);
  if (levels.empty() || found.upside_down) return found;

  const Vec3 u = any_orthogonal(up), v = up.cross(u);
  for (Level& level : levels) set_outline(scan, level, u, v);
  double largest = 0, most_pixels = 0, most = 0;
  const auto pixels = [&](const Level& level) { return static_cast<double>(points_of(scan, level.faces).size()); };
  for (const Level& level : levels) {
    largest = std::max(largest, level.area);
    most_pixels = std::max(most_pixels, pixels(level));
  }
  std::erase_if(levels, [&](const Level& level) {
    return level.area < kSmallestGroundShare * largest && pixels(level) < kSmallestGroundShare * most_pixels;
  });
  weigh_levels(scan, levels, u, v);
  for (const Level& level : levels) most = std::max(most, level.carried);
  const auto height = [&](const Level& level) { return up.dot(level.plane.project(Vec3::Zero())); };
  std::stable_sort(levels.begin(), levels.end(), [&](const Level& a, const Level& b) { return height(a) < height(b); });
  const auto ground = std::find_if(levels.begin(), levels.end(),
                                   [&](const Level& level) { return level.carried >= kCarryShare * most; });
  found.up = ground->plane.normal;
  // A surface that something was seen below ends where it was seen to end; another one goes on.
  const auto below = std::count_if(scan.points.begin(), scan.points.end(), [&](const Vec3& p) {
    return ground->plane.signed_distance(p) < -kBelow;
  });
  const bool ends = static_cast<double>(below) > kBelowShare * static_cast<double>(scan.points.size());
  add_support(found, scan, *ground, SupportKind::ground, ends ? lifted(*ground, u, v) : std::vector<Vec3>{});

  const double smallest_wall = kWallShare * std::pow(scene_radius(scan), 2);
  for (Level& wall : coplanar(scan, upright)) {
    if (wall.area < smallest_wall) continue;
    const Vec3 across = found.up.cross(wall.plane.normal).normalized(), along = wall.plane.normal.cross(across);
    set_outline(scan, wall, across, along);
    if (bounds_the_scene(scan, wall, across, along))
      add_support(found, scan, wall, SupportKind::wall, lifted(wall, across, along));
  }
  for (Level& ceiling : coplanar(scan, downward)) {
    if (ceiling.area < smallest_wall) continue;
    set_outline(scan, ceiling, u, v);
    if (bounds_the_scene(scan, ceiling, u, v))
      add_support(found, scan, ceiling, SupportKind::ceiling, lifted(ceiling, u, v));
  }
  return found;
}

}  // namespace unseen::cuboids
