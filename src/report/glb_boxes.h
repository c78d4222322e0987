// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "report/glb_builder.h"

namespace unseen::report {

/// Boxes with flat faces: each face has vertices of its own.
tinygltf::Primitive boxes_primitive(GlbBuilder& b, const std::vector<OrientedBox>& boxes, int material);

}  // namespace unseen::report
