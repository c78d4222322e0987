// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cuboids/boxes/edge_search.h"
#include "cuboids/boxes/picture_registration.h"
#include "cuboids/objects/slabs.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {
namespace {

constexpr int kMatchRounds = 4;           // closest points are renewed in each
constexpr double kReach[kMatchRounds] = {10.0, 6.0, 4.0, 4.0};  // pixels to an edge
constexpr double kPixelError = 1.5;       // pixels, of an edge
constexpr double kFewestSamples = 12;
constexpr double kInside = 1.5, kOutside = 8.0;  // σ of a side that was seen to end, in mm in and out: measured edges
                                                 // fall short, but points that were measured are there
constexpr double kStanding = 1e-5;               // m, σ of a bottom that stands on the ground
constexpr double kTurn = 0.02;                   // rad, σ of the turn

/// What the picture may do to a box against what was measured.
struct Latitude {
  double seen_side;  ///< mm, σ of a side that was seen as a face
  double slack;      ///< m that the points may be farther from the box on average
  double more_free;  ///< of the box, that may be space that was seen free
};
constexpr std::array<Latitude, 2> kLatitudes = {{{1.5, 0.0005, 0.005}, {0.2, 0.0, -0.001}}};  // the second keeps faces where they were measured

/// What is sought of a box: how far each side moves outward (m; −x, +x, −y, +y, −z, +z) and its turn about its third axis.
using Change = std::array<double, 7>;

OrientedBox changed(const OrientedBox& box, const Change& change) {
  OrientedBox result = box;
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    low[k] = -box.half_size[k] - change[2 * k];
    high[k] = box.half_size[k] + change[2 * k + 1];
  }
  const double c = std::cos(change[6]), s = std::sin(change[6]);
  result.axes.col(0) = c * box.axes.col(0) + s * box.axes.col(1);
  result.axes.col(1) = -s * box.axes.col(0) + c * box.axes.col(1);
  result.center = box.center + result.axes * (0.5 * (low + high));
  result.half_size = 0.5 * (high - low);
  return result;
}

/// Eq. 4.1: distance of a projected point of an edge to its closest point in the image, across the edge.
struct EdgeResidual {
  const OrientedBox& box;
  const Camera& camera;
  RigidTransform T_camera_world;
  EdgeSample sample;
  Vec2 target, across;

  template <class T>
  bool operator()(const T* change, T* residual) const {
    Eigen::Matrix<T, 3, 1> local;
    const auto coordinate = [&](int axis, double side) {
      return side < 0 ? T(-box.half_size[axis] - change[2 * axis]) : T(box.half_size[axis] + change[2 * axis + 1]);
    };
    local[sample.i] = coordinate(sample.i, sample.side_i);
    local[sample.j] = coordinate(sample.j, sample.side_j);
    local[sample.k] = (1.0 - sample.share) * coordinate(sample.k, -1) + sample.share * coordinate(sample.k, 1);
    using std::cos;
    using std::sin;
    const T c = cos(change[6]), s = sin(change[6]);
    const Eigen::Matrix<T, 3, 1> turned(c * local.x() - s * local.y(), s * local.x() + c * local.y(), local.z());
    const Eigen::Matrix<T, 3, 1> world = box.axes.cast<T>() * turned + box.center.cast<T>();
    const Eigen::Matrix<T, 3, 1> p = T_camera_world.rotation.cast<T>() * world + T_camera_world.translation.cast<T>();
    const T u = camera.fx * p.x() / p.z() + camera.cx, v = camera.fy * p.y() / p.z() + camera.cy;
    residual[0] = ((u - target.x()) * across.x() + (v - target.y()) * across.y()) / kPixelError;
    return true;
  }
};

/// What depth says of the sides and of the turn.
struct DepthResidual {
  std::array<double, 6> inside, outside;  ///< m, σ
  double weight;                          ///< as many measurements

  template <class T>
  bool operator()(const T* change, T* residual) const {
    for (int k = 0; k < 6; ++k) residual[k] = weight * change[k] / (change[k] < T(0) ? inside[k] : outside[k]);
    residual[6] = weight * change[6] / kTurn;
    return true;
  }
};

/// m, mean distance of points to the surface of a box.
double misfit(const OrientedBox& box, const std::vector<Vec3>& points) {
  double sum = 0;
  for (const Vec3& p : points) {
    const Vec3 d = (box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size;
    sum += d.maxCoeff() <= 0.0 ? -d.maxCoeff() : d.cwiseMax(0.0).norm();
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

/// Which sides were seen as faces: they look at the camera and points lie on them.
std::array<bool, 6> seen_sides(const OrientedBox& box, const std::vector<Vec3>& points, const Vec3& viewpoint, double sigma) {
  const Vec3 eye = box.axes.transpose() * (viewpoint - box.center);
  std::array<std::size_t, 6> on{};
  for (const Vec3& p : points) {
    const Vec3 local = box.axes.transpose() * (p - box.center);
    for (int k = 0; k < 6; ++k) on[k] += std::abs((k % 2 ? local[k / 2] : -local[k / 2]) - box.half_size[k / 2]) < 2.0 * sigma;
  }
  std::array<bool, 6> seen{};
  for (int k = 0; k < 6; ++k)
    seen[k] = (k % 2 ? eye[k / 2] : -eye[k / 2]) > box.half_size[k / 2] && on[k] * 10 > points.size();
  return seen;
}

bool stands_on(const Support& ground, const OrientedBox& box) {
  return std::abs(ground.plane.signed_distance(box.center - box.half_size.z() * box.axes.col(2))) < 1e-3;
}

/// Beyond the middle of which sides another box of the same stack begins: −x, +x, −y, +y, −z, +z.
std::array<bool, 6> flush_sides(const std::vector<Cuboid>& cuboids, std::size_t k, double probe) {
  std::array<bool, 6> flush{};
  const OrientedBox& box = cuboids[k].box;
  for (int side = 0; side < 6; ++side) {
    const Vec3 beyond = box.center + (side % 2 == 0 ? -1.0 : 1.0) * (box.half_size[side / 2] + probe) * box.axes.col(side / 2);
    flush[side] = std::any_of(cuboids.begin(), cuboids.end(), [&](const Cuboid& other) {
      const bool beside = &other != &cuboids[k] && other.stack >= 0 && other.stack == cuboids[k].stack;
      return beside && ((other.box.axes.transpose() * (beyond - other.box.center)).cwiseAbs() - other.box.half_size).maxCoeff() < probe;
    });
  }
  return flush;
}

struct EdgeProblem {
  const RgbdFrame& frame;
  const ImageEdges& edges;
  RigidTransform T_camera_world;
  PictureRegistration registration;

  Vec2 pixel(const OrientedBox& box, const EdgeSample& sample) const {
    return frame.camera.project(T_camera_world * (box.center + box.axes * local_point(sample, -box.half_size, box.half_size)));
  }
};

Change align(const EdgeProblem& problem, const OrientedBox& box, const std::vector<EdgeSample>& samples, const DepthResidual& depth) {
  Change change{};
  for (int round = 0; round < kMatchRounds; ++round) {
    const OrientedBox now = changed(box, change);
    ceres::Problem sum;
    int found = 0;
    for (std::size_t from = 0, to = 0; from < samples.size(); from = to) {
      std::vector<Vec2> points, across;
      for (to = from; to < samples.size() && samples[to].same_edge(samples[from]); ++to) {
        EdgeSample ahead = samples[to];
        ahead.share += ahead.share < 0.5 ? 0.1 : -0.1;
        points.push_back(problem.registration.to_picture(problem.pixel(now, samples[to])));
        const Vec2 along = (problem.registration.to_picture(problem.pixel(now, ahead)) - points.back()).normalized();
        // Directions of one edge agree in sign.
        const Vec2 normal(-along.y(), along.x());
        across.push_back(across.empty() || normal.dot(across.front()) > 0.0 ? normal : Vec2(-normal));
      }
      const std::vector<double> offsets = agreed_offsets(problem.edges, points, across, kReach[round]);
      for (std::size_t n = 0; n < offsets.size(); ++n) {
        if (std::isnan(offsets[n])) continue;
        ++found;
        const Vec2 target = problem.registration.to_depth(points[n] + offsets[n] * across[n]);
        auto* residual = new EdgeResidual{box, problem.frame.camera, problem.T_camera_world, samples[from + n], target, across[n]};
        sum.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeResidual, 1, 7>(residual), new ceres::CauchyLoss(1.5), change.data());
      }
    }
    if (found < kFewestSamples) return {};
    sum.AddResidualBlock(new ceres::AutoDiffCostFunction<DepthResidual, 7, 7>(new DepthResidual(depth)), nullptr, change.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 6;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &sum, &summary);
    if (!std::all_of(change.begin(), change.end(), [](double c) { return std::isfinite(c); })) return {};
  }
  return change;
}

}  // namespace

void align_to_image_edges(const RgbdFrame& frame, const Observation& seen, const DepthView& view,
                          std::vector<Cuboid>& cuboids, const Options& options, Context& context) {
  if (!options.image_edges || frame.color.empty() || frame.is_fused() || cuboids.empty()) return;
  const ImageEdges edges(frame);
  EdgeProblem problem{frame, edges, seen.T_world_camera.inverse(), {}};
  std::vector<std::vector<EdgeSample>> samples(cuboids.size());
  std::vector<Vec2> creases, all;
  for (std::size_t k = 0; k < cuboids.size(); ++k) {
    samples[k] = visible_edge_samples(cuboids[k].box, frame, seen.T_world_camera, view);
    for (const EdgeSample& sample : samples[k]) {
      const Vec2 pixel = problem.pixel(cuboids[k].box, sample);
      if (sample.crease) creases.push_back(pixel);
      const bool below = (sample.i == 2 && sample.side_i < 0.0) || (sample.j == 2 && sample.side_j < 0.0);
      if (!below) all.push_back(pixel);
    }
  }
  problem.registration = register_picture(edges, creases, all, {frame.camera.cx, frame.camera.cy});
  if (const Vec2& scale = problem.registration.scale; !scale.isOnes())
    context.warn(fmt::format("{}: the colour image does not fit the depth image: it seems {:.2f} times as wide and {:.2f} times as high; boxes' edges are sought so, but register it for better sizes",
                             frame.name, scale.x(), scale.y()));
  context.check();

  std::vector<std::vector<Vec3>> points(cuboids.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    if (seen.support_of_point[i] >= 0) continue;
    for (std::size_t k = 0; k < cuboids.size(); ++k) {
      const OrientedBox& box = cuboids[k].box;
      const Vec3 d = (box.axes.transpose() * (seen.points[i] - box.center)).cwiseAbs() - box.half_size;
      if (d.maxCoeff() < 4.0 * seen.graph.sigma[i]) points[k].push_back(seen.points[i]);
    }
  }
  const std::vector<Cuboid> measured = cuboids;
  const auto one = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Cuboid& cuboid = cuboids[k];
      if (samples[k].size() < kFewestSamples) continue;
      const double sigma = view.sigma(cuboid.box.center), scale = std::max(1.0, sigma / 0.001) * 0.001;
      const auto faces = seen_sides(cuboid.box, points[k], view.viewpoint(), std::max(sigma, 0.001));
      const double voxel = std::max(2.0 * view.spacing(cuboid.box.center), sigma);
      const std::array<bool, 6> flush = flush_sides(measured, k, voxel);
      for (const auto& [seen_side, slack, more_free] : kLatitudes) {
        DepthResidual depth{{}, {}, 0.5 * std::sqrt(static_cast<double>(samples[k].size()) / 6.0)};
        for (int side = 0; side < 6; ++side) {
          depth.inside[side] = (faces[side] ? seen_side : kInside) * scale;
          depth.outside[side] = (faces[side] ? seen_side : flush[side] ? kInside : kOutside) * scale;
        }
        // Below is what it stands on, and its shadow.
        depth.outside[4] = kInside * scale;
        if (stands_on(seen.supports.front(), cuboid.box)) depth.inside[4] = depth.outside[4] = kStanding;
        const OrientedBox aligned = changed(cuboid.box, align(problem, cuboid.box, samples[k], depth));
        if (aligned.half_size.minCoeff() <= 0.0 || misfit(aligned, points[k]) > misfit(cuboid.box, points[k]) + slack) continue;
        // What reaches into space that was seen free could not go down behind what hides it.
        if (filled_share(view, aligned, voxel) < filled_share(view, cuboid.box, voxel) - more_free) continue;
        cuboid.box = cuboid.initial = aligned;
        break;
      }
    }
  };
  parallel_blocks(context, cuboids.size(), 1, one);
}

}  // namespace unseen::cuboids
