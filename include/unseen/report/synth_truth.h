// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/mesh.h"
#include "unseen/core/options.h"
#include "unseen/planes/synth.h"

namespace unseen::report {

/// truth.json of `unseen synth planes` (docs/formats.md): the true planes by label, their frames and the
/// scanners. The label of each point stands in cloud.ply.
std::string synth_truth_json(const planes::SynthScene& scene, const OptionTable& options);

/// A mesh as OBJ, a group "plane_3" for each label in rising order.
std::string labelled_obj(const TriangleMesh& mesh);

}  // namespace unseen::report
