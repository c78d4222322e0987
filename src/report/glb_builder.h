// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "report/palette.h"
#include "unseen/core/geometry.h"

namespace unseen::report {

/// A glTF model under construction: one buffer, to which views are appended, and a root node that turns z up into
/// glTF's y up. Positions are stored relative to `offset`.
struct GlbBuilder {
  explicit GlbBuilder(const Vec3& offset);

  tinygltf::Model model;
  Vec3 offset;

  template <class T>
  int add_accessor(const std::vector<T>& values, int target, int component, int type) {
    tinygltf::Buffer& buffer = model.buffers[0];
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.data.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    buffer.data.resize(buffer.data.size() + view.byteLength);
    std::memcpy(buffer.data.data() + view.byteOffset, values.data(), view.byteLength);
    buffer.data.resize((buffer.data.size() + 3) / 4 * 4);
    model.bufferViews.push_back(view);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = values.size();
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  int add_positions(const std::vector<Vec3>& world);
  int add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles);
  /// A dull material; an opacity below 1 makes it translucent.
  int add_material(const std::string& name, const Rgb& color, double opacity = 1.0);
  tinygltf::Primitive surface(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles, int material);
  /// A node below the root that shows one primitive; gives its index.
  int add_node(const std::string& name, tinygltf::Primitive primitive);
  /// A node below the root that shows nothing yet.
  int add_empty_node(const std::string& name, const Vec3& position = Vec3::Zero(), const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity());
  /// Moves a node: a linear key a time (s, rising from 0 or later). Neighbouring quaternions must have the same sign; without any
  /// the node keeps its rotation. All motions are one animation.
  void add_motion(int node, const std::vector<double>& times, const std::vector<Vec3>& positions, const std::vector<Eigen::Quaterniond>& rotations);
  /// A node of points, each in its colour, without light.
  void add_points(const std::string& name, const std::vector<Vec3>& positions, const std::vector<Rgb>& colors);
  /// The whole file. Nothing can be added after it.
  std::string finish();
};

}  // namespace unseen::report
