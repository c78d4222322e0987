// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace unseen::io {

/// Decodes a PNG or JPEG with its channels and depth as stored (palettes become colours). Throws InputError
/// if it is broken, or if its size is out of all proportion to the file.
cv::Mat decode_image(std::string_view bytes, const std::string& name);

}  // namespace unseen::io
