// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/search/hypotheses.h"
#include "cuboids/search/problem.h"
#include "cuboids/search/search.h"
#include "cuboids/surfaces/depth_view.h"
#include "unseen/core/context.h"
#include "unseen/core/error.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Joins visible parts that an occluder has split: boxes in line whose seen faces lie in common planes, with hidden space
/// between them. `tolerance` (m, a cuboid) shrinks along. Returns how many were joined to others.
std::size_t fuse_pieces(const DepthView& view, std::vector<Cuboid>& cuboids, std::vector<double>& tolerance);

/// Given boxes that are turned by up to some 15° and whose sides are up to 5 % wrong are fitted again to the points that lie nearest to them
/// and look their way; sides that nothing was seen of stay as given.
void realign(const RgbdFrame& frame, const Options& options, Completion& scene, Context& context);

/// Adds the legs of a plate that are wholly hidden where others of its legs are seen, by mirroring them at the plate's
/// middle (thesis Section 4.4.1). Returns how many.
std::size_t add_hidden_legs(const DepthView& view, std::vector<Cuboid>& cuboids, std::vector<double>& tolerance);

/// Boxes around what was seen may overlap, which bodies can't: the face gives way that loses the smallest part of what it may, those that
/// nobody saw before others. Boxes that overlap too far for that are parts of something that is no box: they become rigid together, unless masks
/// tell them apart.
void part_overlaps(const DepthView& view, Problem& problem);

/// The same for what overlaps at the end, if all still stands then; else the two become rigid together, which leaves standing what
/// stands.
void end_overlaps(const DepthView& view, const Problem& problem, const std::vector<char>& held, Arrangement& arrangement);

/// Upright boxes whose back was not seen get a thickness: that of their narrower visible side, as far as hidden space
/// goes. Something covers the upper edge of their back, or that would have shown it.
/// Their rooms shrink along.
void assume_thickness(const DepthView& view, Rooms& rooms, Problem& problem);

/// Faces that nobody saw, with a body no farther off than a few times the tolerance, move to meet it: that a gap so small
/// is where none can look is less likely than a contact. Their rooms shrink along.
void close_hidden_gaps(Rooms& rooms, Problem& problem);

/// Moves by which legs whose upper end is hidden reach the plate over them.
std::vector<FaceMove> legs_to_their_plates(const Problem& problem, const Rooms& rooms, const Arrangement& arrangement);

/// m: how near two faces must be to count as touching, by the noise of the depth there.
std::vector<double> contact_tolerance(const DepthView& view, const std::vector<Cuboid>& cuboids);

/// Moves faces so that what touches touches exactly: hidden faces freely, seen ones as little as possible.
void close_contacts(const Problem& problem, const std::vector<Touch>& touches, Arrangement& arrangement);

/// Whether an arrangement is at rest, the `held` bodies (a mark a body) being firm.
bool stands(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held);

/// Whether it stands under all pushes too.
bool bears_pushes(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held);

/// The cuboids (a mark each) that the picture cuts off.
std::vector<char> cut_off(const DepthView& view, const std::vector<Cuboid>& cuboids);

/// The bodies that are held, or rigid with one that is, and not with a support (a mark a body).
std::vector<char> held_up(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held);
/// Those of them that are not rigid with what is held and cut off by the picture: something outside it can hold that.
std::vector<char> hanging(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held);

/// What nothing can support is held by its neighbour all the same, if nobody could see the link and both still stand: a fixed contact,
/// no longer than what hangs. Such bodies are no longer `held`.
void link_hanging(const Problem& problem, const DepthView& view, std::vector<char>& held, Arrangement& arrangement, Context& context);

inline constexpr double kAtRest = 1e-3;  ///< residual: what is not balanced falls in the end, if slowly
/// The same problem without tolerance: only what touches in the boxes as they will be written touches, but for a rest that counts for nothing.
Problem as_written(const Problem& problem);

/// Boxes that do not quite touch what they rest on, or lean on it askew by noise, come to lie on it: they follow their collapse motion
/// (statics.h) from contact to contact, by a few tolerances at most. What would go farther stays where it was.
void settle(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context);

/// What stands only because contacts within tolerance count, and would fall as the boxes are, becomes rigid with a neighbour: slivers of round
/// things on their edges, and what balances on an edge. What is thick and only leans, and what masks tell apart, stays apart. Returns those
/// that would still fall (a mark a body).
std::vector<char> hold_together(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context);

/// Lowers the residual, at rest and under the pushes, by moves of faces: hidden ones within their rooms, seen ones within
/// noise (Eq. 4.4). Every step is one that `admissible` allows.
void lower_residual(const Problem& problem, const Rooms& rooms, const Admissible& admissible, const std::vector<char>& held,
                    Arrangement& arrangement, Context& context);

/// From boxes around what is visible (`result.cuboids`) to a scene that stands.
void complete_boxes(const RgbdFrame& frame, const Options& options, Context& context, Completion& result);

/// Lets `body` fill a result, and says so if it was stopped.
template <typename Body>
Completion run_cuboids(Context& context, Completion result, const Body& body) {
  try {
    body(result);
  } catch (const Cancelled&) {
    Summary summary = std::move(result.summary);
    result = Completion();
    result.summary = std::move(summary);
    result.summary.status = Status::cancelled;
  }
  result.summary.warnings = context.take_warnings();
  return result;
}

}  // namespace unseen::cuboids
