// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>

#include "unseen/core/geometry.h"

namespace unseen {

/// Nearest of some points, which must outlive the tree and stay as they are.
/// @tparam Points a vector of Vec3
template <class Points>
class PointTree {
 public:
  explicit PointTree(const Points& points, std::size_t points_a_leaf = 10) : view_{points}, tree_(3, view_, {points_a_leaf}) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Indices of the (at most) `count` points nearest to `p` and their squared distances, the nearest first.
  /// @returns how many there are
  std::size_t nearest(const Vec3& p, std::size_t count, std::uint32_t* index, double* squared) const {
    return tree_.knnSearch(p.data(), count, index, squared);
  }

  /// Shows points to `result`, one of nanoflann's result sets or one like them.
  template <class Result>
  void find(const Vec3& p, Result& result) const {
    tree_.findNeighbors(result, p.data(), {});
  }

 private:
  struct View {
    const Points& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  View view_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, View>, View, 3, std::uint32_t> tree_;
};

}  // namespace unseen
