// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/core/options.h"
#include "unseen/cuboids/synth.h"
#include "unseen/cuboids/truth.h"

namespace unseen::report {

/// Units of depth.png of a synthetic view a metre.
inline constexpr double kSynthDepthScale = 10000.0;

/// truth.json of a view of `unseen synth cuboids` (docs/formats.md).
std::string cuboids_truth_json(const cuboids::SynthView& view, const OptionTable& options);

/// frame.json of such a view: depth.png, color.png, the camera, and masks.png if asked for.
std::string synth_frame_json(const cuboids::SynthView& view, bool with_masks);

/// Depth in units of kSynthDepthScale, as depth.png holds it.
std::vector<std::uint16_t> synth_depth_pixels(const cuboids::SynthView& view);

/// Reads such a truth.json. Throws InputError.
cuboids::Truth read_cuboids_truth(const std::filesystem::path& path);

}  // namespace unseen::report
