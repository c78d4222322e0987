// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/database/saliency.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "interactions/database/motion_descriptor.h"
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
    const Eigen::Matrix<float, kJointLines, kDescriptorPoses> scaled = motion_descriptor(scenelets[i].poses) * scale.asDiagonal();
    columns.col(static_cast<Eigen::Index>(i)) = scaled.reshaped().cast<double>();
  }
  return columns;
}

constexpr Eigen::Index kBins = kGrid * kGrid, kOwn = static_cast<Eigen::Index>(kCategories.size()) * kBins;  ///< bins of categories
constexpr Eigen::Index kAll = kOwn + 3 * kBins;  ///< and behind them those of superclasses: who sits does so on a chair here, a couch there

/// What a scenelet has in a bin. Few bins are not empty.
struct Entry {
  Eigen::Index scenelet, bin;
  double share;
};

std::vector<Entry> entries(const std::vector<Scenelet>& scenelets) {
  std::vector<Entry> all;
  for (std::size_t i = 0; i < scenelets.size(); ++i) {
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(kAll);
    for (Eigen::Index bin = 0; bin < kOwn; ++bin) {
      shares[bin] = static_cast<double>(scenelets[i].layout[static_cast<std::size_t>(bin)]);
      const Superclass superclass = superclass_of(kCategories[static_cast<std::size_t>(bin / kBins)]);
      if (superclass == Superclass::other) continue;
      double& shared = shares[kOwn + static_cast<Eigen::Index>(superclass) * kBins + bin % kBins];
      shared = std::max(shared, shares[bin]);
    }
    for (Eigen::Index bin = 0; bin < kAll; ++bin)
      if (shares[bin] > 0) all.push_back({static_cast<Eigen::Index>(i), bin, shares[bin]});
  }
  return all;
}

/// Weighted means of what scenelets have in each bin; a row a row of weights, which sum to 1.
Table means(const Table& weights, const std::vector<Entry>& entries) {
  Table mean = Table::Zero(weights.rows(), kAll);
  for (const Entry& entry : entries) mean.col(entry.bin) += entry.share * weights.col(entry.scenelet);
  return mean;
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

std::vector<Scenelet> with_saliency(std::vector<Scenelet> scenelets, double sigma, const Context& context) {
  if (scenelets.empty()) return scenelets;
  const Table motion = motions(scenelets);
  const std::vector<Entry> layout = entries(scenelets);
  const Eigen::RowVectorXd length2 = motion.colwise().squaredNorm();
  const std::vector<double> density = densities(scenelets);
  const Eigen::VectorXd rarity = Eigen::Map<const Eigen::VectorXd>(density.data(), static_cast<Eigen::Index>(density.size())).cwiseInverse();
  const Eigen::RowVectorXd chance = means(rarity.transpose() / rarity.sum(), layout).rightCols(kAll - kOwn);
  parallel_blocks(context, scenelets.size(), kBlock, [&](std::size_t first, std::size_t end) {
    const auto begin = static_cast<Eigen::Index>(first), rows = static_cast<Eigen::Index>(end - first);
    Table weight = -2.0 * motion.middleCols(begin, rows).transpose() * motion;  // becomes squared distances, then G / ρ
    weight.rowwise() += length2;
    weight.colwise() += length2.segment(begin, rows).transpose().eval();
    weight = (weight.array().max(0.0) * (-0.5 / (sigma * sigma))).exp().matrix() * rarity.asDiagonal();
    const Eigen::VectorXd total = weight.rowwise().sum();
    weight = total.cwiseInverse().asDiagonal() * weight;
    const Table h = means(weight, layout);
    for (Eigen::Index i = 0; i < rows; ++i) {
      Scenelet& scenelet = scenelets[static_cast<std::size_t>(begin + i)];
      scenelet.saliency.resize(static_cast<std::size_t>(kOwn));
      for (Eigen::Index bin = 0; bin < kOwn; ++bin) scenelet.saliency[static_cast<std::size_t>(bin)] = static_cast<float>(h(i, bin));
      const auto lift = (h.row(i).tail(kAll - kOwn) - chance).array() / (1.0 + 1e-9 - chance.array());
      scenelet.highest_saliency = std::clamp(lift.maxCoeff(), 0.0, 1.0);
    }
  });
  return scenelets;
}

}  // namespace unseen::interactions
