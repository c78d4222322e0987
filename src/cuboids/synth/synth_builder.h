// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "unseen/core/random.h"
#include "unseen/cuboids/synth.h"

namespace unseen::cuboids {

/// A scene before it is looked at: z up, z = 0 on the ground, the front is towards −y. Supports come first in the
/// numbering of ids: ground 0, wall 1 if there is one, then the boxes in the order in which they were built.
struct SynthModel {
  std::vector<Support> supports;
  std::vector<OrientedBox> boxes;
  std::vector<Contact> contacts;  ///< a < b
  bool stands = true;
  double camera_height = 1.4;  ///< m
  double ground_margin = 2.5;  ///< m, how far the ground reaches beyond the boxes

  int id_of_box(std::size_t index) const { return static_cast<int>(supports.size() + index); }
};

/// Puts a scene together. Boxes are named by the order in which they were added.
class SynthBuilder {
 public:
  /// A box with its lower side's centre at `foot`, turned by `yaw` (rad) about the vertical.
  int stand(const Vec3& foot, const Vec3& size, double yaw = 0.0);
  int add(const OrientedBox& box);
  /// A plank that leans: `foot` is the middle of the lower edge of its underside, `heading` the horizontal direction in
  /// which it rises at `slope` (rad). Size: length, width, thickness.
  int lean(const Vec3& foot, double heading, double slope, const Vec3& size);
  void fix(int a, int b) { fixed_.emplace_back(a, b); }
  void fix_to_wall(int a) { fixed_to_wall_.push_back(a); }
  /// A contact in a single point, which the search for faces and edges would not find.
  void touch(int a, int b) { touching_.emplace_back(a, b); }
  /// The wall's plane is y = `y`; it is seen from smaller y.
  void set_wall(double y) { wall_ = y; }
  bool has_wall() const { return wall_.has_value(); }
  /// m, of the highest y of any box.
  double back() const;

  /// All contacts found; the model is complete but for its camera.
  SynthModel take() const;

 private:
  std::vector<OrientedBox> boxes_;
  std::vector<std::pair<int, int>> fixed_, touching_;
  std::vector<int> fixed_to_wall_;
  std::optional<double> wall_;
};

/// True if faces of the two share more than 1 cm² or an edge of one lies on a face of the other for more than 5 mm.
bool boxes_touch(const OrientedBox& a, const OrientedBox& b);
/// The corners, the bits of the index choosing the sides.
std::array<Vec3, 8> corners_of(const OrientedBox& box);

// The families. Each builds boxes and says from how high they are looked at.
struct SynthFrame {
  double camera_height = 1.4, ground_margin = 2.5;
  bool stands = true;
};
SynthFrame build_tower(SynthBuilder& builder, int boxes, Random& random);
SynthFrame build_twisted(SynthBuilder& builder, int boxes, Random& random);
SynthFrame build_running_bond(SynthBuilder& builder, int boxes, Random& random);
SynthFrame build_bridge(SynthBuilder& builder, bool counterweights);
SynthFrame build_leaning(SynthBuilder& builder);
SynthFrame build_cyclic(SynthBuilder& builder);
SynthFrame build_jam(SynthBuilder& builder);
SynthFrame build_bookshelf(SynthBuilder& builder, Random& random);
SynthFrame build_desk(SynthBuilder& builder);
SynthFrame build_four_legged_chair(SynthBuilder& builder);
SynthFrame build_pedestal_chair(SynthBuilder& builder);
SynthFrame build_table(SynthBuilder& builder);
SynthFrame build_shelf(SynthBuilder& builder);

/// The picture from `azimuth` (rad) of a model; `shown` boxes only, but the camera stands where all are in view.
SynthView photograph(const SynthModel& model, const std::vector<bool>& shown, double azimuth, const SynthOptions& options,
                     Context& context);

}  // namespace unseen::cuboids
