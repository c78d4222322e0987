// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>

#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"

namespace unseen::io {

/// Writes all points of a source in the format of the ending, block by block: ply (binary, double
/// coordinates, with normals, colours and labels), pcd (binary, the same, with single coordinates where none moves by 0.01 mm), xyz (text: position, normal,
/// colour), csv (with a header line; all of them) or las (1.2, point format 0: positions only, without
/// non-finite ones; the finest decimal scale that covers the extent). The file appears complete or not at
/// all. What a format cannot hold is a warning of the context. Throws InputError (path, reason) before
/// reading if the ending is unknown or the place cannot be written to, and if there are no points.
void write_points(const std::filesystem::path& path, PointSource& source, Context& context);

}  // namespace unseen::io
