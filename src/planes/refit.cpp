// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr double kFloor = 0.03 * kPi / 180.0;  // rad: no plane is known better than this

/// Where a node's unknowns start in the vector of all: three for a root, one for a child.
std::vector<int> unknowns_of(const Model& model, int& total) {
  std::vector<int> start;
  total = 0;
  for (const FrameNode& node : model.nodes) {
    start.push_back(total);
    total += node.parent < 0 ? 3 : 1;
  }
  return start;
}

/// Rotation vector of a node as the sum of its own and its ancestors' unknowns: (column, axis) pairs.
std::vector<std::pair<int, Vec3>> columns_of(const Model& model, const std::vector<int>& start, int node) {
  std::vector<std::pair<int, Vec3>> columns;
  for (; node >= 0; node = model.nodes[node].parent) {
    const FrameNode& f = model.nodes[node];
    if (f.parent >= 0) {
      columns.emplace_back(start[node], f.frame.axes.col(0));
    } else {
      for (int a = 0; a < 3; ++a) columns.emplace_back(start[node] + a, Vec3::Unit(a));
    }
  }
  return columns;
}

/// Orthonormal again after a step, with the first axis untouched.
void orthonormalise(Mat3& axes) {
  axes.col(0).normalize();
  axes.col(1) = (axes.col(1) - axes.col(1).dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
}

void turn(Model& model, const std::vector<int>& start, const Eigen::VectorXd& step) {
  std::vector<Vec3> rotation(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    FrameNode& node = model.nodes[i];
    if (node.parent < 0) {
      rotation[i] = step.segment<3>(start[i]);
    } else {
      rotation[i] = rotation[node.parent] + step[start[i]] * node.frame.axes.col(0);
    }
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    FrameNode& node = model.nodes[i];
    const double angle = rotation[i].norm();
    if (angle > 0) node.frame.axes = Eigen::AngleAxisd(angle, rotation[i] / angle) * node.frame.axes;
    if (node.parent >= 0) node.frame.axes.col(0) = model.nodes[node.parent].frame.axes.col(node.parent_axis);
    orthonormalise(node.frame.axes);
  }
}

}  // namespace

void refit(Model& model) {
  int total = 0;
  const std::vector<int> start = unknowns_of(model, total);
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(total, total);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(total);
    for (const PlaneModel& plane : model.planes) {
      const Vec3 n = model.normal(plane);
      const PlaneFit& fit = plane.support.fit;
      const auto columns = columns_of(model, start, plane.frame);
      const auto add = [&](const Vec3& u, double variance) {
        const double weight = 1.0 / (variance + kFloor * kFloor), residual = n.dot(u);
        const Vec3 j = n.cross(u);  // d(n·u) = w·(n × u)
        for (const auto& [a, axis_a] : columns) {
          const double ja = axis_a.dot(j);
          gradient[a] -= weight * ja * residual;
          for (const auto& [b, axis_b] : columns) information(a, b) += weight * ja * axis_b.dot(j);
        }
      };
      add(fit.u, plane.support.variance_u);
      add(fit.v, plane.support.variance_v);
    }
    // What no plane constrains stays where it is.
    const double damping = 1e-9 * std::max(information.diagonal().maxCoeff(), 1e-300);
    information.diagonal().array() += damping;
    const Eigen::VectorXd step = information.ldlt().solve(gradient);
    turn(model, start, step);
    if (step.norm() < 1e-13) break;
  }
  std::map<int, std::pair<double, double>> common;  // coplanar group → Σ count·offset, Σ count
  for (PlaneModel& plane : model.planes) {
    plane.offset = model.normal(plane).dot(plane.support.moments.mean);
    if (plane.coplanar < 0) continue;
    auto& [sum, count] = common[plane.coplanar];
    sum += plane.support.moments.count * plane.offset;
    count += plane.support.moments.count;
  }
  for (PlaneModel& plane : model.planes)
    if (plane.coplanar >= 0) plane.offset = common[plane.coplanar].first / common[plane.coplanar].second;
}

void update_support(PlaneModel& plane, const Moments& moments, const Space& space) {
  if (moments.count < 3) return;
  Patch& s = plane.support;
  const auto plain = [](const PlaneFit& fit, double spread, double count) {
    return fit.rms * fit.rms / std::max(count * spread * spread, 1e-300);
  };
  const double inflate_u = s.variance_u / std::max(plain(s.fit, s.fit.spread_u, s.moments.count), 1e-300);
  const double inflate_v = s.variance_v / std::max(plain(s.fit, s.fit.spread_v, s.moments.count), 1e-300);
  s.moments = moments;
  s.fit = fit_plane(moments, space);
  s.variance_u = std::clamp(inflate_u, 1.0, 1e6) * plain(s.fit, s.fit.spread_u, moments.count);
  s.variance_v = space.is_2d() ? 0.0 : std::clamp(inflate_v, 1.0, 1e6) * plain(s.fit, s.fit.spread_v, moments.count);
}

}  // namespace unseen::planes
