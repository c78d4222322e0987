// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/observation.h"
namespace unseen::cuboids {
void align_to_image_edges(const RgbdFrame&, const Observation&, const DepthView&, std::vector<Cuboid>&, const Options&, Context&) {}
}  // namespace unseen::cuboids
