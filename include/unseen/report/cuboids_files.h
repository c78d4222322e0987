// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::report {

/// scene.glb (binary glTF 2.0): nodes "box 3 (tea), seen", opaque, and "box 3 (tea), hidden", translucent, in the box's
/// colour; "desk 0" a support; "points", the depth cloud. The root node turns z up into glTF's y up.
std::string cuboids_glb(const cuboids::Completion& completion, const RgbdFrame& frame);

/// scene.xml (MJCF): a free body a box or group of fixed boxes, with masses; supports without end are planes, those with
/// an outline slabs. What is fixed to a support or cannot be supported does not move. Settings that judge stacks
/// well: 1 ms steps, elliptic cones, impratio 20, Newton, 5 noslip iterations.
std::string cuboids_mjcf(const cuboids::Completion& completion, double friction);

/// scene.urdf: a link a box or support; fixed joints for fixed contacts, floating joints to "world" for the others.
std::string cuboids_urdf(const cuboids::Completion& completion, double friction);

}  // namespace unseen::report
