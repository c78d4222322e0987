// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "cuboids/statics/interface.h"
#include "cuboids/statics/statics.h"
#include "unseen/core/geometry.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// How far each face of a box is moved outward, m. Face 2k is the one at the negative end of axis k, 2k+1 at the positive.
using Extension = std::array<double, 6>;

/// Outward unit normal of a face.
Vec3 face_normal(const OrientedBox& box, int face);
OrientedBox extended(const OrientedBox& box, const Extension& extension);
OrientedBox extended(const OrientedBox& box, int face, double length);

/// What one hypothesis asks of a box: that a face moves outward by at least `length`.
struct FaceMove {
  int body = -1;  ///< index of the body: supports first, then cuboids
  int face = -1;
  double length = 0;
};

/// One way in which a pair of bodies may be in contact, beyond what the initial boxes give.
struct Hypothesis {
  int a = -1, b = -1;  ///< bodies, a < b
  ContactKind kind = ContactKind::touching;
  std::vector<FaceMove> moves;
};

/// Bodies are numbered: supports first, then cuboids.
struct Problem {
  std::vector<Support> supports;
  std::vector<Cuboid> cuboids;          ///< with their initial boxes
  std::vector<double> tolerance;        ///< m, a cuboid: contacts within it count as touching
  std::vector<char> cut_off;            ///< a mark a cuboid: the picture cuts it off; empty = none
  std::vector<std::array<int, 2>> joints;  ///< pairs of bodies that hold an object's pieces together
  std::vector<Hypothesis> hypotheses;
  double friction = 0.7;
  double stable_residual = 0.02;
  double push = 0.1;  ///< g: horizontal acceleration, from any side, that an arrangement must bear

  int supports_count() const { return static_cast<int>(supports.size()); }
  int bodies() const { return static_cast<int>(supports.size() + cuboids.size()); }
  bool is_support(int body) const { return body < supports_count(); }
  const Cuboid& cuboid(int body) const { return cuboids[body - supports_count()]; }
  bool is_cut_off(int body) const { return !is_support(body) && !cut_off.empty() && cut_off[body - supports_count()]; }
  double pair_tolerance(int a, int b) const;
  bool is_one_object(int a, int b) const {
    return !is_support(a) && !is_support(b) && cuboid(a).object >= 0 && cuboid(a).object == cuboid(b).object;
  }
  /// A mask said so.
  bool are_known_objects(int a, int b) const { return !is_support(a) && !is_support(b) && !cuboid(a).label.empty() && !cuboid(b).label.empty(); }
};

/// Pairs that connect the pieces of every object, each to its nearest.
std::vector<std::array<int, 2>> joints_of(const Problem& problem);

/// A choice of hypotheses, and what follows from it.
struct Arrangement {
  std::vector<Extension> extension;     ///< a cuboid
  std::vector<OrientedBox> boxes;       ///< a cuboid
  std::vector<ConvexSolid> solids;      ///< a cuboid
  std::vector<std::array<int, 2>> fixed;  ///< pairs of bodies, ordered, the joints among them
  double extended_volume = 0;           ///< m³

  void fix(const std::array<int, 2>& pair) {
    const auto at = std::lower_bound(fixed.begin(), fixed.end(), pair);
    if (at == fixed.end() || *at != pair) fixed.insert(at, pair);
  }
};

/// Boxes after the moves of the chosen hypotheses; where several move one face, the longest move counts.
Arrangement arrange(const Problem& problem, const std::vector<int>& chosen);

inline constexpr double kMostShrink = 0.3;  ///< of the size as fitted, by one face
/// With a face moved farther out, or in, but by no more than that.
Arrangement with_face(const Problem& problem, Arrangement arrangement, int cuboid, int face, double move);

/// m³ that the moves of a hypothesis would add.
double added_volume(const Problem& problem, const Arrangement& arrangement, const Hypothesis& hypothesis);

/// A pair of bodies that meet.
struct Touch {
  int a = -1, b = -1;
  Interface interface;
};
/// All pairs of different objects within tolerance of each other, ordered.
std::vector<Touch> touching_pairs(const Problem& problem, const Arrangement& arrangement);
std::optional<Touch> touch_of(const Problem& problem, const Arrangement& arrangement, int a, int b);
/// The touches of an arrangement in which, since they were found, one body has moved a little.
std::vector<Touch> with_moved(const Problem& problem, const Arrangement& arrangement, std::vector<Touch> touches, int body);
/// True if a pair of bodies overlaps by more than its tolerance, and more than the initial boxes did.
bool penetrates(const Problem& problem, const Arrangement& arrangement);

/// Accelerations (g) that an arrangement must bear: gravity alone, then with a push from each of eight sides.
std::vector<Vec3> load_cases(double push);

/// The arrangement as statics sees it: fixed bodies merged.
struct Structure {
  std::vector<int> group;  ///< a body: which of `bodies` it belongs to
  std::vector<Body> bodies;
  std::vector<ContactPoint> contacts;
  std::vector<int> touch_of_contact;  ///< index into the touches it was made from
};
/// `held` bodies are static (a mark a body).
Structure structure_of(const Problem& problem, const Arrangement& arrangement, const std::vector<Touch>& touches,
                       const std::vector<char>& held);

}  // namespace unseen::cuboids
