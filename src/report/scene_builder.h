// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/json_write.h"
#include "unseen/core/geometry.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// A scene of a page under construction: the header, and the buffer that its arrays lie in (docs/scene.md).
class SceneBuilder {
 public:
  /// Scene coordinates are world coordinates less `offset`.
  explicit SceneBuilder(const Vec3& offset);

  Json header;

  /// Appends a structure to the header; the reference holds until the next one is added.
  Json& add(std::string_view kind, std::string_view id, std::string_view name);

  /// Each of these appends an array to the buffer and returns its description. Positions are in world
  /// coordinates, metres; those of points get 16 bits a coordinate.
  Json point_positions(std::span<const Vec3> world);
  Json positions(std::span<const Vec3> world);
  Json vectors(std::span<const Vec3> values);
  Json quaternions(std::span<const float> values);  ///< four numbers each
  Json ranges(std::span<const float> values);       ///< low and high corner, six numbers each
  Json scalars(std::span<const float> values);
  /// In 256 steps from low to high; what lies beyond counts as the nearer end.
  Json coarse_scalars(std::span<const float> values, double low, double high);
  Json integers(std::span<const int> values);
  Json pairs(std::span<const std::array<int, 2>> values);
  /// sRGB, three bytes a colour.
  Json colors(std::span<const std::array<std::uint8_t, 3>> values);
  /// Bytes as they are, of a picture.
  Json bytes(std::string_view values);
  Json triples(std::span<const std::array<int, 3>> values);

  /// The whole scene: gzip, in base64.
  std::string encode() const;

 private:
  Json describe(std::size_t count, int components, const char* type) const;
  void append(const void* data, std::size_t size);
  Json floats(std::span<const float> values, int components);
  Json deltas(std::span<const int> values, int components);

  Vec3 offset_;
  std::string buffer_;
};

/// A quantity (docs/scene.md) of kind "label" or "scalar", to be given more fields if need be.
Json quantity(std::string_view id, std::string_view name, std::string_view kind, Json array, std::string_view unit = "");

/// Adds a fact to the header; `help` says what it means.
void add_fact(SceneBuilder& scene, std::string_view name, std::string value, std::string_view help = "");
/// A column of a table; `digits` behind the point, −1 = as many as it takes.
Json column(std::string_view name, std::string_view unit = "", int digits = -1);
/// Adds a table to the header, unless it has no rows. With a structure, row i is about its element i.
void add_table(SceneBuilder& scene, std::string_view title, Json columns, Json rows, std::string_view structure = "");

/// What the header says of a run: capability, command, version, summary, options, input.
void write_run(SceneBuilder& scene, std::string_view capability, const std::string& command, const Summary& summary, const OptionTable& options,
               const InputRecord& input);

/// What a structure of kind "camera" says of its camera.
void write_camera(Json& to, const RigidTransform& T_world_camera, const Camera& camera);

}  // namespace unseen::report
