// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <numeric>

#include "planes/selection/select.h"

namespace unseen::planes {
namespace {

constexpr double kIndistinct = 4.0;  // χ²: two standard errors
constexpr double kWorse = 9.0;        // χ² by which an orientation may suit a patch less than another one that is nearly the same
constexpr double kDominant = 1.0 / 3;  // of the area
constexpr double kBetter = 2.0, kHardlyWorse = 1.0;  // χ² by which the frame of a face beside a patch suits it clearly better than another, or hardly worse: sides of a box go together

/// A patch to which a frame offers an orientation.
struct Offered {
  std::size_t patch;
  int local;
};

/// Patches from whose own orientation the one that a frame offers does not differ.
std::vector<Offered> suited_by(const OrientationFrame& frame, const Patches& patches, const std::vector<Vec3>& locals, double patch_angle) {
  std::vector<Offered> suited;
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    if (patch.bowed) continue;
    const Candidate c = best_candidate(patch, frame, locals, patch_angle);
    if (c.local >= 0 && tilt_chi2(patch, frame.direction(locals[c.local])) < kIndistinct) suited.push_back({j, c.local});
  }
  return suited;
}

/// Adds the proposed frame that suits the most area, if that is much of the whole: the energy may have shared it out among
/// frames that are needed for something else.
void add_dominant_frame(const Patches& patches, const std::vector<Vec3>& locals, double patch_angle, const Context& context, Selection& s) {
  const std::vector<OrientationFrame>& proposed = s.proposed;
  std::vector<double> areas(proposed.size(), 0.0);
  parallel_blocks(context, proposed.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (proposed[k].closed)
        for (const Offered& o : suited_by(proposed[k], patches, locals, patch_angle)) areas[k] += patches.patches[o.patch].area;
  });
  double all = 0;
  for (const Patch& patch : patches.patches)
    if (!patch.bowed) all += patch.area;
  const auto largest = std::max_element(areas.begin(), areas.end());
  if (largest == areas.end() || *largest < kDominant * all) return;
  OrientationFrame frame = proposed[largest - areas.begin()];
  for (int i = 0; i < 3; ++i) {
    std::vector<std::pair<const Patch*, int>> members;
    for (const Offered& o : suited_by(frame, patches, locals, patch_angle)) members.emplace_back(&patches.patches[o.patch], o.local);
    frame = refit_frame(frame, locals, members);
  }
  s.frames.push_back(frame);
}

/// An orientation that a frame offers a patch.
struct Orientation {
  std::size_t frame;
  int local;
  Vec3 direction;
  double chi2;
};

/// By patch: the orientations that suit it, which it has or from which its own does not differ. Lines of a drawing have one angle, and many differ
/// little by chance: they are given no other orientation.
std::vector<std::vector<Orientation>> suiting(const Patches& patches, const std::vector<Vec3>& has, const std::vector<Vec3>& locals, double patch_angle, const Space& space, const Selection& s) {
  std::vector<std::vector<Orientation>> suits(patches.patches.size());
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    const Patch& patch = patches.patches[j];
    if (patch.bowed) continue;
    for (std::size_t k = 0; k < s.frames.size(); ++k) {
      const Candidate c = best_candidate(patch, s.frames[k], locals, patch_angle);
      if (c.local < 0) continue;
      const Vec3 direction = s.frames[k].direction(locals[c.local]);
      const double chi2 = tilt_chi2(patch, direction);
      const bool same = line_angle(direction, has[j]) < kSameOrientation && chi2 < tilt_chi2(patch, has[j]) + kWorse;
      if (same || (!space.is_2d() && chi2 < kIndistinct)) suits[j].push_back({k, c.local, direction, chi2});
    }
  }
  return suits;
}

/// Leaves a patch, of the orientations that suit it, those which suit the largest of the patches that it adjoins and whose own suits it, too: panes go with their wall.
void follow_neighbours(const Patches& patches, const std::vector<Vec3>& has, std::vector<std::vector<Orientation>>& suits) {
  std::vector<std::size_t> leader(patches.patches.size());
  std::iota(leader.begin(), leader.end(), 0);
  for (const auto& [a, b] : patches.neighbours)  // a is no smaller than b, and the smaller its index the larger it is
    if (static_cast<std::size_t>(a) < leader[b] && !patches.patches[a].bowed && tilt_chi2(patches.patches[b], has[a]) < kIndistinct) leader[b] = a;
  for (std::size_t j = 0; j < leader.size(); ++j) {
    std::vector<Orientation> shared;
    for (const Orientation& o : suits[j])
      if (std::any_of(suits[leader[j]].begin(), suits[leader[j]].end(),
                      [&](const Orientation& l) { return l.frame == o.frame && line_angle(l.direction, o.direction) < kSameOrientation; }))
        shared.push_back(o);
    if (!shared.empty()) suits[j] = std::move(shared);
  }
}

/// Whether all of a patch lies on one side of another's plane, as far as its moments tell.
bool is_beside(const Patch& patch, const Patch& other) {
  constexpr double kRim = 1.5;  // standard deviations from the centre; √3 is the rim of what is evenly spread
  const Vec3& n = other.fit.normal;
  const double spread = std::sqrt(std::max(0.0, n.dot(patch.moments.scatter * n)) / patch.moments.count);
  return std::abs(n.dot(patch.moments.mean - other.moments.mean)) > kRim * spread;
}

/// Whether two patches end at an edge that they share, as sides of a box do, and not one before the middle of the other.
bool share_edge(const Patch& a, const Patch& b) {
  constexpr double kLeast = 45.0 * kPi / 180.0;
  return line_angle(a.fit.normal, b.fit.normal) > kLeast && is_beside(a, b) && is_beside(b, a);
}

/// Takes from a patch the orientations of frames that a face with which it shares an edge certainly does not have, where another suits both: it suits the patch clearly better, or
/// hardly worse and no other face speaks for the first. The sides of a cabinet that stands a little askew are turned with its front, though the narrow ones alone would fit the room, too.
void follow_faces(const Patches& patches, const std::vector<Vec3>& locals, double patch_angle, const std::vector<OrientationFrame>& frames, std::vector<std::vector<Orientation>>& suits) {
  std::vector<std::vector<int>> beside(suits.size());
  for (const auto& [a, b] : patches.adjoining)
    if (share_edge(patches.patches[a], patches.patches[b])) beside[a].push_back(b), beside[b].push_back(a);
  const auto has = [&](int patch, const Orientation& o) { return std::any_of(suits[patch].begin(), suits[patch].end(), [&](const Orientation& own) { return own.frame == o.frame; }); };
  const auto cannot_have = [&](int patch, const Orientation& o) {
    const Candidate c = best_candidate(patches.patches[patch], frames[o.frame], locals, patch_angle);
    return c.local < 0 || tilt_chi2(patches.patches[patch], frames[o.frame].direction(locals[c.local])) > kCertain;
  };
  /// Whether a face beside the patch has the one frame and cannot have the other.
  const auto speaks_for = [&](std::size_t j, const Orientation& one, const Orientation& other) {
    return std::any_of(beside[j].begin(), beside[j].end(), [&](int b) { return has(b, one) && !has(b, other) && cannot_have(b, other); });
  };
  std::vector<std::vector<Orientation>> kept = suits;
  for (std::size_t j = 0; j < suits.size(); ++j)
    std::erase_if(kept[j], [&](const Orientation& o) {
      return std::any_of(suits[j].begin(), suits[j].end(), [&](const Orientation& other) {
        return other.chi2 < o.chi2 + kHardlyWorse && speaks_for(j, other, o) && (other.chi2 + kBetter < o.chi2 || !speaks_for(j, o, other));
      });
    });
  for (std::size_t j = 0; j < suits.size(); ++j)
    if (!kept[j].empty()) suits[j] = std::move(kept[j]);
}

/// Where several frames offer a patch an orientation that suits it, the frame that can have the most area takes it, then the one that can have most of
/// what is left: a room keeps its floor when a table shares it, and walls stay together.
void give_to_largest(const Patches& patches, const std::vector<Vec3>& locals, double patch_angle, const Space& space, Selection& s) {
  std::vector<Vec3> has(patches.patches.size(), Vec3::Zero());  // none of bowed patches
  for (std::size_t j = 0; j < has.size(); ++j)
    if (!patches.patches[j].bowed) has[j] = s.frames[s.frame_of_patch[j]].direction(locals[s.local_of_patch[j]]);
  std::vector<std::vector<Orientation>> suits = suiting(patches, has, locals, patch_angle, space, s);
  if (!space.is_2d()) {
    follow_faces(patches, locals, patch_angle, s.frames, suits);
    follow_neighbours(patches, has, suits);
  }
  std::vector<std::vector<Offered>> offers(s.frames.size());
  for (std::size_t j = 0; j < suits.size(); ++j)
    for (const Orientation& o : suits[j]) offers[o.frame].push_back({j, o.local});
  std::vector<char> given(patches.patches.size(), 0);
  for (std::size_t round = 0; round < s.frames.size(); ++round) {
    std::size_t largest = 0;
    double most = 0;
    for (std::size_t k = 0; k < s.frames.size(); ++k) {
      double area = 0;
      for (const Offered& o : offers[k])
        if (!given[o.patch]) area += patches.patches[o.patch].area;
      if (area > most) {
        most = area;
        largest = k;
      }
    }
    if (most == 0) break;
    for (const Offered& o : offers[largest]) {
      if (given[o.patch]) continue;
      given[o.patch] = 1;
      s.frame_of_patch[o.patch] = static_cast<int>(largest);
      s.local_of_patch[o.patch] = o.local;
    }
  }
}

}  // namespace

void share_out(const Patches& patches, const AngleSet& angles, const Space& space, const Options& options, const Context& context, Selection& s) {
  if (s.local_fits) return;
  const std::vector<Vec3> locals = local_directions(angles, space);
  const double patch_angle = radians(options.patch_angle);
  if (s.frames.size() > 1 && !space.is_2d()) add_dominant_frame(patches, locals, patch_angle, context, s);
  give_to_largest(patches, locals, patch_angle, space, s);
  for (std::size_t j = 0; j < patches.patches.size(); ++j) {
    if (!patches.patches[j].bowed) continue;
    s.frame_of_patch[j] = static_cast<int>(s.frames.size());
    s.local_of_patch[j] = 0;
    s.frames.push_back(open_frame(patches.patches[j].fit.normal, space));
  }
}

}  // namespace unseen::planes
