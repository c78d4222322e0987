// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "unseen/core/rgbd_frame.h"

namespace unseen::io {

/// Reads one RGB-D frame: a FRAME.json (docs/formats.md), or a folder with a frame.json or, without one, with the
/// usual names of a dataset (depth.png, color.png or rgb.png, intrinsics.json or camera-intrinsics.txt). Depth is a
/// 16-bit PNG or TIFF, a TIFF or EXR of floats, or an organised PCD; colour is PNG or JPEG. Depths that are not
/// finite, not positive or at the end of 16 bits become 0 (unknown). Throws InputError (file, field, found, expected).
RgbdFrame read_rgbd_frame(const std::filesystem::path& path);

/// "nx,ny,nz,d" or "nx,ny,nz,d,kind", several separated by ";": planes n·p = d in the camera's coordinates.
/// `source` starts the message of the InputError.
std::vector<GivenSupport> parse_supports(const std::string& text, const std::string& source);

}  // namespace unseen::io
