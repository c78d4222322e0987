// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

/// Scenelets of the same recording per m² at the origin of each: kernels of 0.2 m, its own included, which keeps it above 4 / m².
std::vector<double> densities(const std::vector<Scenelet>& scenelets);

/// The scenelets with their bin saliencies h and H (thesis Section 6.2.3): the layouts of similar motions, averaged.
/// `sigma` is the width of the Gaussian in motion distance, m.
std::vector<Scenelet> with_saliency(std::vector<Scenelet> scenelets, double sigma);

}  // namespace unseen::interactions
