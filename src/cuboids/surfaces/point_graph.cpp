// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/point_graph.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "core/point_tree.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallestSigma = 0.0005;   // m; files hold whole millimetres, and no sensor is better close up
constexpr int kReach = 3;                   // pixels; some sensors leave out every few lines
constexpr int kMinWindow = 4, kMaxWindow = 12;  // pixels each way, of the surroundings that give a normal
constexpr double kOnSurface = 3.0;          // standard deviations of the inverse depth
constexpr std::size_t kMostCloudPoints = 200000;
constexpr int kCloudNeighbours = 12;

/// Normal and flatness of one point from the sums over its surroundings.
void set_normal(PointGraph& graph, const Vec3& point, int i, const Vec3& sum, const Mat3& scatter, double count) {
  graph.normals[i] = Vec3::Zero();
  graph.flatness[i] = std::numeric_limits<float>::infinity();
  if (count < 6) return;
  const Vec3 mean = sum / count;
  const Mat3 covariance = scatter / count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(covariance);
  if (!(eigen.eigenvalues()[1] > 0.0) || eigen.eigenvalues()[1] < 2.0 * eigen.eigenvalues()[0]) return;
  Vec3 normal = eigen.eigenvectors().col(0);
  if (!normal.allFinite()) return;
  if (normal.dot(point) > 0.0) normal = -normal;
  graph.normals[i] = normal;
  graph.flatness[i] = static_cast<float>(std::sqrt(std::max(normal.dot(covariance * normal), 0.0)) / graph.sigma[i]);
}

/// The point that a pixel measured, or −1, also outside the picture.
int point_at(const Camera& camera, const Measured& m, int x, int y) {
  return x < 0 || y < 0 || x >= camera.width || y >= camera.height ? -1 : m.point_of_pixel[static_cast<std::size_t>(y) * camera.width + x];
}

/// A plane's inverse depth is linear in the picture, and what sensors measure of it is as noisy near as far: how it changes from one
/// pixel to another tells whether both lie on one surface, however slanted that is.
double inverse_depth(const Measured& m, int i) { return 1.0 / m.points[i].z(); }
double inverse_sigma(const Measured& m, const PointGraph& graph, int i) { return graph.sigma[i] / (m.points[i].z() * m.points[i].z()); }

/// Change of inverse depth along a row or column at i, where the neighbours before and after it (−1 = not measured) agree on it; else not a number.
double slope_of(const Measured& m, int before, int i, int after, double error) {
  if (before < 0 || after < 0) return std::numeric_limits<double>::quiet_NaN();
  const double w = inverse_depth(m, i), a = w - inverse_depth(m, before), b = inverse_depth(m, after) - w;
  return std::abs(a - b) <= 2.0 * error ? 0.5 * (a + b) : std::numeric_limits<double>::quiet_NaN();
}

/// Surroundings in the picture: 5 × 5 samples, as wide as the noise asks for (about 3° of error of the normal).
/// One pixel of each 2 × 2 is worked out; the others of it take its normal if they lie on its surface.
void normals_of_image(const Camera& camera, const Measured& m, PointGraph& graph, const Context& context) {
  const double focal = std::min(camera.fx, camera.fy);
  const auto leader = [&](std::size_t i) -> int {
    const int u = m.pixel_of_point[i] % camera.width, v = m.pixel_of_point[i] / camera.width;
    const int j = m.point_of_pixel[static_cast<std::size_t>(v & ~1) * camera.width + (u & ~1)];
    const bool near = j >= 0 && std::abs(m.points[j].z() - m.points[i].z()) < 2.0 * (graph.sigma[i] + graph.spacing[i]);
    return near ? j : static_cast<int>(i);
  };
  const auto at = [&](int x, int y) { return point_at(camera, m, x, y); };
  const auto leaders = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (leader(i) != static_cast<int>(i)) continue;
      const Vec3& p = m.points[i];
      const double sigma = graph.sigma[i], spacing = p.z() / focal;
      const int half = std::clamp(static_cast<int>(7.0 * sigma / spacing), kMinWindow, kMaxWindow), step = half / 2;
      const int u = m.pixel_of_point[i] % camera.width, v = m.pixel_of_point[i] / camera.width;
      const double inverse = inverse_depth(m, static_cast<int>(i)), error = kOnSurface * inverse_sigma(m, graph, static_cast<int>(i));
      const double slope_u = slope_of(m, at(u - step, v), static_cast<int>(i), at(u + step, v), error);
      const double slope_v = slope_of(m, at(u, v - step), static_cast<int>(i), at(u, v + step), error);
      Vec3 sum = Vec3::Zero();
      Mat3 scatter = Mat3::Zero();
      double count = 0;
      for (int dv = -2; dv <= 2; ++dv)
        for (int du = -2; du <= 2; ++du) {
          const int j = at(u + du * step, v + dv * step);
          if (j < 0) continue;
          const Vec3 d = m.points[j] - p;
          const int far = std::max(std::abs(du), std::abs(dv));
          const bool level = std::abs(d.z()) <= 3.0 * sigma + 2.5 * spacing * step * far;
          const bool slanted = std::abs(inverse_depth(m, j) - inverse - slope_u * du - slope_v * dv) <= error * (1 + far);
          if (!level && !slanted) continue;
          sum += d;
          scatter += d * d.transpose();
          count += 1;
        }
      set_normal(graph, p, static_cast<int>(i), sum, scatter, count);
    }
  };
  const auto followers = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (const int j = leader(i); j != static_cast<int>(i)) graph.normals[i] = graph.normals[j], graph.flatness[i] = graph.flatness[j];
  };
  parallel_blocks(context, m.points.size(), 8192, leaders);
  parallel_blocks(context, m.points.size(), 8192, followers);
}

/// Links to the next measured pixel to the right and below, if it lies on the same surface.
std::vector<std::pair<int, int>> image_links(const Camera& camera, const Measured& m, const PointGraph& graph,
                                             std::optional<double> gap) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(2 * m.points.size());
  // From the pixel before both to the one after both, inverse depth changes by the same amount each time.
  const auto slanted = [&](int i, int x, int y, int j, int dx, int dy) {
    const int before = point_at(camera, m, x - dx, y - dy), after = point_at(camera, m, x + 2 * dx, y + 2 * dy);
    if (before < 0 || after < 0) return false;
    const double change = inverse_depth(m, j) - inverse_depth(m, i), error = 2.0 * kOnSurface * inverse_sigma(m, graph, i);
    return std::abs(change - (inverse_depth(m, i) - inverse_depth(m, before))) <= error && std::abs(inverse_depth(m, after) - inverse_depth(m, j) - change) <= error;
  };
  const auto link = [&](int i, int x, int y, int dx, int dy) {
    for (int step = 1; step <= kReach; ++step) {
      const int u = x + dx * step, v = y + dy * step;
      if (u >= camera.width || v >= camera.height) return;
      const int j = m.point_of_pixel[static_cast<std::size_t>(v) * camera.width + u];
      if (j < 0) continue;
      const double allowed =
          gap.value_or(4.0 * std::max(graph.sigma[i], graph.sigma[j]) + (3.0 + step) * graph.spacing[i]);
      if ((m.points[i] - m.points[j]).norm() <= allowed || (!gap && step == 1 && slanted(i, x, y, j, dx, dy))) pairs.emplace_back(i, j);
      return;
    }
  };
  for (int i = 0; i < static_cast<int>(m.points.size()); ++i) {
    const int x = m.pixel_of_point[i] % camera.width, y = m.pixel_of_point[i] / camera.width;
    link(i, x, y, 1, 0);
    link(i, x, y, 0, 1);
  }
  return pairs;
}

/// Nearest points of a cloud give links, normals and the spacing.
std::vector<std::pair<int, int>> cloud_links(const Measured& m, PointGraph& graph, std::optional<double> gap,
                                             const Context& context) {
  const PointTree tree(m.points, 16);
  const std::size_t count = m.points.size(), wanted = std::min<std::size_t>(kCloudNeighbours + 1, count);
  std::vector<std::array<unsigned, kCloudNeighbours + 1>> index(count);
  std::vector<std::array<double, kCloudNeighbours + 1>> distance(count);
  const auto block = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest(m.points[i], wanted, index[i].data(), distance[i].data());
      Vec3 sum = Vec3::Zero();
      Mat3 scatter = Mat3::Zero();
      for (std::size_t k = 0; k < wanted; ++k) {
        const Vec3 d = m.points[index[i][k]] - m.points[i];
        sum += d;
        scatter += d * d.transpose();
      }
      graph.spacing[i] = static_cast<float>(std::sqrt(distance[i][std::min<std::size_t>(4, wanted - 1)]));
      set_normal(graph, m.points[i], static_cast<int>(i), sum, scatter, static_cast<double>(wanted));
    }
  };
  parallel_blocks(context, count, 4096, block);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 1; k < wanted; ++k) {
      const std::size_t j = index[i][k];
      const double allowed = gap.value_or(4.0 * graph.sigma[i] + 4.0 * graph.spacing[i]);
      if (std::sqrt(distance[i][k]) > allowed || j == i) continue;
      pairs.emplace_back(static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j)));
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// One point a cell, the first of the cloud that falls into it; cells grow until few enough are left.
std::vector<Vec3> thinned(const std::vector<Vec3>& points) {
  std::vector<Vec3> kept = points;
  double low = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) low = std::min(low, p.minCoeff());
  for (double cell = 0.002; kept.size() > kMostCloudPoints; cell *= 1.4) {
    std::unordered_map<std::uint64_t, bool> seen;
    std::vector<Vec3> next;
    for (const Vec3& p : kept) {
      const Eigen::Matrix<std::uint64_t, 3, 1> c = ((p.array() - low) / cell).floor().cast<std::uint64_t>();
      if (seen.emplace((c.x() << 42) ^ (c.y() << 21) ^ c.z(), true).second) next.push_back(p);
    }
    kept = std::move(next);
  }
  return kept;
}

}  // namespace

Measured measured_points(const RgbdFrame& frame) {
  Measured m;
  if (frame.is_fused()) {
    for (std::size_t i = 0; i < frame.cloud.size(); ++i)
      if (frame.cloud.positions[i].allFinite()) m.points.push_back(frame.cloud_point(i));
    m.points = thinned(m.points);
    return m;
  }
  const Camera& camera = frame.camera;
  m.point_of_pixel.assign(frame.depth.size(), -1);
  m.points.reserve(frame.depth.size());
  m.pixel_of_point.reserve(frame.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double depth = frame.depth[i];
    if (!std::isfinite(depth) || depth <= 0.0) continue;
    m.point_of_pixel[i] = static_cast<int>(m.points.size());
    m.pixel_of_point.push_back(static_cast<int>(i));
    m.points.push_back(camera.unproject(static_cast<double>(i % camera.width), static_cast<double>(i / camera.width), depth));
  }
  return m;
}

PointGraph link_points(const RgbdFrame& frame, const Measured& m, double noise, std::optional<double> gap,
                       const Context& context) {
  const std::size_t count = m.points.size();
  PointGraph graph;
  graph.normals.assign(count, Vec3::Zero());
  graph.flatness.assign(count, 0.0f);
  graph.sigma.resize(count);
  graph.spacing.resize(count);
  const double focal = frame.is_fused() ? 1.0 : std::min(frame.camera.fx, frame.camera.fy);
  for (std::size_t i = 0; i < count; ++i) {
    const double depth = frame.is_fused() ? m.points[i].norm() : m.points[i].z();
    graph.sigma[i] = static_cast<float>(std::max(noise * depth * depth, kSmallestSigma));
    graph.spacing[i] = static_cast<float>(depth / focal);
  }
  std::vector<std::pair<int, int>> pairs;
  if (frame.is_fused()) {
    pairs = cloud_links(m, graph, gap, context);
  } else {
    normals_of_image(frame.camera, m, graph, context);
    pairs = image_links(frame.camera, m, graph, gap);
  }
  graph.start.assign(count + 1, 0);
  for (const auto& [a, b] : pairs) ++graph.start[a + 1], ++graph.start[b + 1];
  for (std::size_t i = 0; i < count; ++i) graph.start[i + 1] += graph.start[i];
  graph.links.resize(graph.start[count]);
  std::vector<int> at(graph.start.begin(), graph.start.end() - 1);
  for (const auto& [a, b] : pairs) {
    graph.links[at[a]++] = b;
    graph.links[at[b]++] = a;
  }
  return graph;
}

}  // namespace unseen::cuboids
