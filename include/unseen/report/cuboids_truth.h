// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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

/// A dimension that a picture hides, by the name of its object.
struct HiddenDimension {
  std::string name;
  double size = 0;  ///< m
};

/// "W:263,W:199": names and millimetres. `source` starts the message of the InputError.
std::vector<HiddenDimension> parse_hidden_dimensions(const std::string& text, const std::string& source);

/// Reads truth without poses: sizes in millimetres by name ("dims_mm"), and for the frame named as `frame_folder` the
/// object of each label and the contacts ("frames": {"obj", "edges"}). The folder holds a frame and its label.png; labels
/// below 10 are the support, and those with the same tens digit one object. Throws InputError.
cuboids::Truth read_measured_truth(const std::filesystem::path& path, const std::filesystem::path& frame_folder,
                                   const std::vector<HiddenDimension>& hidden);

}  // namespace unseen::report
