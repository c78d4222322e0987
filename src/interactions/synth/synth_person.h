// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/synth/synth_acts.h"
#include "interactions/synth/synth_path.h"

namespace unseen::interactions {

/// What a person does for so many seconds in a room with others, whose motions are fixed: walks, sits, reaches, leans, lies and stands about,
/// or, `still`, only walks and stands about. Empty if others leave no way to do so.
Motion live(const Room& room, const FloorPlan& plan, const Body& body, const std::vector<std::pair<Body, Motion>>& others, double seconds, bool still,
            Random& random);

/// The moment at a time, s; between two of the motion.
Moment at_time(const Motion& motion, double time);

}  // namespace unseen::interactions
