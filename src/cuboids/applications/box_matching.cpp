// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/box_matching.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr double kHeight = 0.05, kLength = 0.1;   // m: what matching edges differ by at most (thesis, Section 4.5)
constexpr double kSizeSpread = 0.05;              // m: σ of sizes in the affinity
constexpr double kRelationSpread = 0.05;          // m: σ of distances between boxes in the affinity
constexpr double kFarthestRelation = 3.0;         // σ: relations that differ more contradict each other
constexpr int kPowerRounds = 100;
constexpr double kLevel = 0.02;                   // sine: edges that lean more are not horizontal

struct Edge {
  Vec3 from, to;
  double length() const { return (to - from).norm(); }
  double height() const { return 0.5 * (from.z() + to.z()); }
};

std::vector<Edge> horizontal_edges(const OrientedBox& box) {
  std::vector<Edge> out;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(box.axes(2, k)) > kLevel) continue;
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        Vec3 corner;
        corner[k] = -box.half_size[k];
        corner[(k + 1) % 3] = s * box.half_size[(k + 1) % 3];
        corner[(k + 2) % 3] = t * box.half_size[(k + 2) % 3];
        Vec3 end = corner;
        end[k] = -end[k];
        out.push_back({box.center + box.axes * corner, box.center + box.axes * end});
      }
  }
  return out;
}

bool edges_agree(const Edge& a, const Edge& b) {
  return std::abs(a.height() - b.height()) <= kHeight && std::abs(a.length() - b.length()) <= kLength;
}

bool may_match(const OrientedBox& a, const OrientedBox& b) {
  const std::vector<Edge> first = horizontal_edges(a), second = horizontal_edges(b);
  return std::any_of(first.begin(), first.end(), [&](const Edge& e) {
    return std::any_of(second.begin(), second.end(), [&](const Edge& f) { return edges_agree(e, f); });
  });
}

/// Height, and the two lengths in plan from small to large.
Vec3 upright_size(const OrientedBox& box) {
  int up = 0;
  box.axes.row(2).cwiseAbs().maxCoeff(&up);
  const double a = 2.0 * box.half_size[(up + 1) % 3], b = 2.0 * box.half_size[(up + 2) % 3];
  return {2.0 * box.half_size[up], std::min(a, b), std::max(a, b)};
}

double size_affinity(const OrientedBox& a, const OrientedBox& b) {
  return std::exp(-(upright_size(a) - upright_size(b)).squaredNorm() / (2.0 * kSizeSpread * kSizeSpread));
}

/// How alike the relation of two boxes of the model is to that of two boxes of the scene: rise and distance in plan.
double relation_affinity(const OrientedBox& a, const OrientedBox& b, const OrientedBox& c, const OrientedBox& d) {
  const Vec3 model = b.center - a.center, scene = d.center - c.center;
  const Vec2 off = Vec2(model.z() - scene.z(), model.head<2>().norm() - scene.head<2>().norm()) / kRelationSpread;
  return off.cwiseAbs().maxCoeff() > kFarthestRelation ? 0.0 : std::exp(-0.5 * off.squaredNorm());
}

}  // namespace

SpectralMatch match_boxes(const std::vector<OrientedBox>& model, const std::vector<OrientedBox>& scene) {
  std::vector<BoxMatch> pairs;
  for (std::size_t m = 0; m < model.size(); ++m)
    for (std::size_t s = 0; s < scene.size(); ++s)
      if (may_match(model[m], scene[s])) pairs.push_back({static_cast<int>(m), static_cast<int>(s)});
  SpectralMatch out;
  if (pairs.empty()) return out;
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd affinity = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = i; j < count; ++j) {
      const BoxMatch &p = pairs[i], &q = pairs[j];
      if (i == j) {
        affinity(i, i) = size_affinity(model[p.model_box], scene[p.cuboid]);
      } else if (p.model_box != q.model_box && p.cuboid != q.cuboid) {
        const double alike = relation_affinity(model[p.model_box], model[q.model_box], scene[p.cuboid], scene[q.cuboid]);
        affinity(i, j) = affinity(j, i) = alike * std::sqrt(size_affinity(model[p.model_box], scene[p.cuboid]) *
                                                           size_affinity(model[q.model_box], scene[q.cuboid]));
      }
    }
  Eigen::VectorXd confidence = Eigen::VectorXd::Ones(count).normalized();
  for (int round = 0; round < kPowerRounds && affinity.sum() > 0.0; ++round) confidence = (affinity * confidence).normalized();

  // The most confident pair, then the next that does not contradict it, and so on.
  Eigen::VectorXd left = confidence, chosen = Eigen::VectorXd::Zero(count);
  const double least = 1e-3 * confidence.maxCoeff();
  for (Eigen::Index best = 0; left.maxCoeff(&best) > least;) {
    chosen[best] = 1.0;
    out.matches.push_back(pairs[best]);
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool same_box = pairs[i].model_box == pairs[best].model_box || pairs[i].cuboid == pairs[best].cuboid;
      if (same_box || affinity(i, best) <= 0.0) left[i] = 0.0;
    }
  }
  out.score = chosen.dot(affinity * chosen);
  return out;
}

std::vector<RigidTransform> alignments(const std::vector<OrientedBox>& model, const std::vector<OrientedBox>& scene,
                                       const std::vector<BoxMatch>& matches) {
  std::vector<RigidTransform> out;
  for (const BoxMatch& match : matches) {
    const std::vector<Edge> from = horizontal_edges(model[match.model_box]), to = horizontal_edges(scene[match.cuboid]);
    for (const Edge& a : from)
      for (const Edge& b : to) {
        if (!edges_agree(a, b)) continue;
        for (const bool swapped : {false, true}) {
          const Vec3 first = swapped ? b.to : b.from, second = swapped ? b.from : b.to;
          const double yaw = std::atan2((second - first).y(), (second - first).x()) - std::atan2((a.to - a.from).y(), (a.to - a.from).x());
          RigidTransform T;
          T.rotation = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
          T.translation = 0.5 * (first + second) - T.rotation * (0.5 * (a.from + a.to));
          T.translation.z() = 0.0;
          const bool known = std::any_of(out.begin(), out.end(), [&](const RigidTransform& other) {
            return (other.translation - T.translation).norm() < 0.01 && (other.rotation - T.rotation).norm() < 0.02;
          });
          if (!known) out.push_back(T);
        }
      }
  }
  return out;
}

}  // namespace unseen::cuboids
