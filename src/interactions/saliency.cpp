// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/saliency.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "interactions/motion_descriptor.h"
#include "unseen/core/context.h"

namespace unseen::interactions {
namespace {

constexpr double kBandwidth = 0.2;         ///< m
constexpr std::size_t kBlock = 256;        ///< scenelets compared with all others at a time

using Table = Eigen::MatrixXd;  // in single precision the order of sums, which depends on the machine, would show in the database

/// A column a scenelet: its motion, scaled so that plain distances of columns are motion distances.
Table motions(const std::vector<Scenelet>& scenelets) {
  const Eigen::Matrix<float, kDescriptorPoses, 1> scale = pose_weights().cwiseSqrt();
  Table columns(kJointLines * kDescriptorPoses, scenelets.size());
  for (std::size_t i = 0; i < scenelets.size(); ++i) {
    const Eigen::Matrix<float, kJointLines, kDescriptorPoses> scaled = scenelets[i].motion * scale.asDiagonal();
    columns.col(static_cast<Eigen::Index>(i)) = scaled.reshaped().cast<double>();
  }
  return columns;
}

/// A row a scenelet, a column a bin that any scenelet uses; `used` says which.
Table layouts(const std::vector<Scenelet>& scenelets, std::vector<std::size_t>& used) {
  for (std::size_t bin = 0; bin < scenelets.front().layout.size(); ++bin)
    if (std::any_of(scenelets.begin(), scenelets.end(), [&](const Scenelet& s) { return s.layout[bin] > 0; })) used.push_back(bin);
  Table rows(scenelets.size(), used.size());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index j = 0; j < rows.cols(); ++j) rows(i, j) = static_cast<double>(scenelets[static_cast<std::size_t>(i)].layout[used[static_cast<std::size_t>(j)]]);
  return rows;
}

/// The same by superclass (all but "other"): who sits does so on a chair here and on a couch there.
Table superclass_layouts(const std::vector<Scenelet>& scenelets) {
  constexpr Eigen::Index kBins = kGrid * kGrid;
  Table rows = Table::Zero(static_cast<Eigen::Index>(scenelets.size()), 3 * kBins);
  for (std::size_t category = 0; category < kCategories.size(); ++category) {
    const Superclass superclass = superclass_of(kCategories[category]);
    if (superclass == Superclass::other) continue;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      auto block = rows.row(i).segment(static_cast<Eigen::Index>(superclass) * kBins, kBins);
      block = block.cwiseMax(Eigen::Map<const Eigen::RowVectorXf>(&scenelets[static_cast<std::size_t>(i)].layout[category * kBins], kBins).cast<double>());
    }
  }
  return rows;
}

}  // namespace

std::vector<double> densities(const std::vector<Scenelet>& scenelets) {
  std::map<int, std::vector<std::size_t>> by_recording;
  for (std::size_t i = 0; i < scenelets.size(); ++i) by_recording[scenelets[i].recording].push_back(i);
  std::vector<double> density(scenelets.size(), 0.0);
  for (const auto& [recording, members] : by_recording)
    for (const std::size_t i : members)
      for (const std::size_t j : members) {
        const Vec3 apart = scenelets[i].origin.position - scenelets[j].origin.position;
        density[i] += std::exp(-apart.squaredNorm() / (2 * kBandwidth * kBandwidth)) / (2 * kPi * kBandwidth * kBandwidth);
      }
  return density;
}

std::vector<Scenelet> with_saliency(std::vector<Scenelet> scenelets, double sigma) {
  if (scenelets.empty()) return scenelets;
  const Table motion = motions(scenelets);
  std::vector<std::size_t> used;
  const Table layout = layouts(scenelets, used);
  const Table by_superclass = superclass_layouts(scenelets);
  const Eigen::RowVectorXd length2 = motion.colwise().squaredNorm();
  const std::vector<double> density = densities(scenelets);
  const Eigen::VectorXd rarity = Eigen::Map<const Eigen::VectorXd>(density.data(), static_cast<Eigen::Index>(density.size())).cwiseInverse();
  const Eigen::RowVectorXd chance = rarity.transpose() * by_superclass / rarity.sum();
  parallel_blocks({}, scenelets.size(), kBlock, [&](std::size_t first, std::size_t end) {
    const auto begin = static_cast<Eigen::Index>(first), rows = static_cast<Eigen::Index>(end - first);
    Table weight = -2.0 * motion.middleCols(begin, rows).transpose() * motion;  // becomes squared distances, then G / ρ
    weight.rowwise() += length2;
    weight.colwise() += length2.segment(begin, rows).transpose().eval();
    weight = (weight.array().max(0.0) * (-0.5 / (sigma * sigma))).exp().matrix() * rarity.asDiagonal();
    const Eigen::VectorXd total = weight.rowwise().sum();
    weight = total.cwiseInverse().asDiagonal() * weight;
    const Table h = weight * layout, by_motion = weight * by_superclass;
    for (Eigen::Index i = 0; i < rows; ++i) {
      Scenelet& scenelet = scenelets[static_cast<std::size_t>(begin + i)];
      scenelet.saliency.assign(scenelet.layout.size(), 0.0f);
      for (std::size_t j = 0; j < used.size(); ++j) scenelet.saliency[used[j]] = static_cast<float>(h(i, static_cast<Eigen::Index>(j)));
      const auto lift = (by_motion.row(i) - chance).array() / (1.0 + 1e-9 - chance.array());
      scenelet.highest_saliency = std::clamp(lift.maxCoeff(), 0.0, 1.0);
    }
  });
  return scenelets;
}

}  // namespace unseen::interactions
