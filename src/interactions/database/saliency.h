// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

/// Scenelets of the same recording per m² at the origin of each: kernels of 0.2 m, its own included, which keeps it above 4 / m².
std::vector<double> densities(const std::vector<Scenelet>& scenelets);

/// The scenelets with their bin saliencies h (thesis Section 6.2.3): the layouts of similar motions, averaged; and H, the highest one.
/// H differs from the thesis in that it is of superclasses, and in that what all motions have in a bin (`chance`) is taken off:
/// (h − chance) / (1 − chance). In four recordings of three rooms the median H of sitting is then 0.52 and of walking 0.09, by the thesis'
/// formula 0.48 and 0.25, for every room has something near. `sigma` is the width of the Gaussian in motion distance, m; of 0.04 to 0.5
/// the thesis' 13 (as cm) told sitting from walking best there.
std::vector<Scenelet> with_saliency(std::vector<Scenelet> scenelets, double sigma, const Context& context);

}  // namespace unseen::interactions
