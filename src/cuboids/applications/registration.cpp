// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/registration.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "core/point_tree.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr double kPointShare = 0.02;  // weight of the distance to the point beside that to its plane
constexpr int kRounds = 40;
constexpr double kShrink = 0.8, kLeastReach = 0.25;  // of the reach, a round and at last
constexpr double kStill = 1e-5;                       // m and radians: nothing moves any more

}  // namespace

struct SampledSurface::Tree : PointTree<std::vector<Vec3>> {
  using PointTree::PointTree;
};

SampledSurface::SampledSurface(std::vector<Vec3> points, std::vector<Vec3> normals)
    : points_(std::move(points)), normals_(std::move(normals)), tree_(std::make_unique<Tree>(points_)) {
  if (normals_.size() == points_.size()) return;
  normals_.assign(points_.size(), Vec3::UnitZ());
  const std::size_t count = std::min(kNeighbours, points_.size());
  std::vector<std::uint32_t> index(count);
  std::vector<double> squared(count);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::size_t found = tree_->nearest(points_[i], count, index.data(), squared.data());
    Vec3 mean = Vec3::Zero();
    for (std::size_t k = 0; k < found; ++k) mean += points_[index[k]] / static_cast<double>(found);
    Mat3 spread = Mat3::Zero();
    for (std::size_t k = 0; k < found; ++k) spread += (points_[index[k]] - mean) * (points_[index[k]] - mean).transpose();
    normals_[i] = symmetric_eigen(spread).vectors.col(0);
  }
}

SampledSurface::~SampledSurface() = default;

std::optional<int> SampledSurface::nearest(const Vec3& p, double within) const {
  if (points_.empty()) return std::nullopt;
  std::uint32_t index = 0;
  double squared = 0.0;
  if (tree_->nearest(p, 1, &index, &squared) == 0 || squared > within * within) return std::nullopt;
  return static_cast<int>(index);
}

Registration register_upright(const std::vector<Vec3>& source, const SampledSurface& target, const RigidTransform& start, double reach) {
  Registration out{start, 0.0, 0.0};
  double within = reach;
  for (int round = 0; round < kRounds; ++round) {
    Vec3 middle = Vec3::Zero();  // turning about the middle keeps the system well conditioned
    for (const Vec3& p : source) middle += out.T_target_source * p / static_cast<double>(source.size());
    Eigen::Matrix4d normal_matrix = Eigen::Matrix4d::Identity() * 1e-12;
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squared = 0.0;
    std::size_t matched = 0;
    for (const Vec3& p : source) {
      const Vec3 at = out.T_target_source * p;
      const auto partner = target.nearest(at, within);
      if (!partner) continue;
      const Vec3 gap = target.points()[*partner] - at, n = target.normals()[*partner];
      Eigen::Matrix<double, 3, 4> motion;  // of the point, by yaw and x, y, z
      motion << Vec3::UnitZ().cross(at - middle), Mat3::Identity();
      const Eigen::RowVector4d along = n.transpose() * motion;
      normal_matrix += along.transpose() * along + kPointShare * motion.transpose() * motion;
      right += along.transpose() * n.dot(gap) + kPointShare * motion.transpose() * gap;
      squared += std::pow(n.dot(gap), 2);
      ++matched;
    }
    out.matched = source.empty() ? 0.0 : static_cast<double>(matched) / static_cast<double>(source.size());
    if (matched < 4) return out;
    out.rms = std::sqrt(squared / static_cast<double>(matched));
    const Eigen::Vector4d step = solve_symmetric(normal_matrix, right);
    const Mat3 turn = Eigen::AngleAxisd(step[0], Vec3::UnitZ()).toRotationMatrix();
    out.T_target_source = RigidTransform{turn, middle - turn * middle + step.tail<3>()} * out.T_target_source;
    const bool narrowest = within <= kLeastReach * reach;
    if (narrowest && step.cwiseAbs().maxCoeff() < kStill) break;
    within = std::max(kShrink * within, kLeastReach * reach);
  }
  return out;
}

std::vector<Vec3> every_nth(const std::vector<Vec3>& points, std::size_t count) {
  if (points.size() <= count) return points;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(points[i * points.size() / count]);
  return out;
}

}  // namespace unseen::cuboids
