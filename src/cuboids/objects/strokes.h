// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// Object of each point by grab-cut on colour and depth, seeded from the frame's strokes (thesis, Section 4.3.1; Rother et
/// al., "GrabCut", 2004). −1 = none; else an index into the labels of the frame's strokes in their order, without doubles.
std::vector<int> cut_by_strokes(const RgbdFrame& frame, const Observation& seen);
/// The same by the stroke that is nearest along the surface (Dijkstra's algorithm; steps over concave creases and changes of colour are long).
/// Nothing spreads from one part of the automatic segmentation (−1 = none) to another.
std::vector<int> spread_strokes(const RgbdFrame& frame, const Observation& seen, const std::vector<int>& part_of_point);

std::vector<std::string> stroke_labels(const RgbdFrame& frame);

}  // namespace unseen::cuboids
