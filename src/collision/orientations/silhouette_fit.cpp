// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/silhouette_fit.h"

#include <algorithm>
#include <array>

#include "collision/solve/rotation.h"

namespace unseen::collision {

SilhouetteFit::SilhouetteFit(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin, std::size_t end)
    : body_(body), camera_(camera), looks_(looks), begin_(begin), end_(end) {
  unit_ = body.solid.mass.inertia.mean() / std::max(1e-3, looks[end - 1].time - looks[begin].time);
}

std::vector<Quat> SilhouetteFit::path(const Turning& turning) const {
  const Vec3& inertia = body_.solid.mass.inertia;
  std::vector<Quat> all(end_ - begin_);
  std::size_t middle = begin_;
  while (middle < end_ && looks_[middle].time < turning.time) ++middle;
  Quat q = turning.q;
  double time = turning.time;
  const auto go = [&](std::size_t i) {
    q = turned(q, turning.h, inertia, looks_[i].time - time);
    time = looks_[i].time;
    all[i - begin_] = q;
  };
  for (std::size_t i = middle; i < end_; ++i) go(i);
  q = turning.q;
  time = turning.time;
  for (std::size_t i = middle; i-- > begin_;) go(i);
  return all;
}

SilhouetteFit::Residuals SilhouetteFit::residuals(const Turning& turning) const {
  const std::vector<Quat> q = path(turning);
  Residuals r(static_cast<Eigen::Index>(kDirections), static_cast<Eigen::Index>(q.size()));
  for (std::size_t i = 0; i < q.size(); ++i)
    r.col(static_cast<Eigen::Index>(i)) = silhouette_residual(body_, camera_, looks_[begin_ + i], q[i]);
  return r;
}

double SilhouetteFit::cost(const Residuals& r) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < r.cols(); ++i) sum += frame_loss(r.col(i).squaredNorm());
  return sum;
}

Turning SilhouetteFit::moved(const Turning& turning, const Vector6& move) const {
  Turning next = turning;
  next.q = (rotation_by<double>(Vec3(move.head<3>())) * turning.q).normalized();
  next.h = turning.h + unit_ * move.tail<3>();
  return next;
}

void SilhouetteFit::linearise(const Turning& turning, const Residuals& r, Matrix6& normal, Vector6& gradient) const {
  constexpr double kStep = 1e-4;
  std::array<Residuals, 6> slopes;
  for (int k = 0; k < 6; ++k) slopes[static_cast<std::size_t>(k)] = (residuals(moved(turning, kStep * Vector6::Unit(k))) - r) / kStep;
  normal.setZero();
  gradient.setZero();
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    Eigen::Matrix<double, kDirections, 6> j;
    for (int k = 0; k < 6; ++k) j.col(k) = slopes[static_cast<std::size_t>(k)].col(i);
    const double weight = frame_weight(r.col(i).squaredNorm());
    normal += weight * j.transpose() * j;
    gradient += weight * j.transpose() * r.col(i);
  }
}

}  // namespace unseen::collision
