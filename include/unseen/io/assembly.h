// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/mesh.h"

namespace unseen::io {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
  std::optional<double> density;  ///< kg/m³, if the file names one
};

/// Blocks that stand on and against each other.
struct Assembly {
  std::vector<NamedMesh> blocks;
  std::vector<std::string> supports;  ///< names of the blocks that the file says do not move
};

/// Reads an assembly of blocks, in the units of the file (taken as metres). Two formats:
///
/// - ours: {"blocks": [BLOCK, …], "supports": [id, …]?}, BLOCK being a box {"id", "center": [x,y,z],
///   "axes": three rows, each an axis (optional: those of the world), "size": [sx,sy,sz] full lengths along the axes}
///   or a solid {"id", "vertices": [[x,y,z], …], "faces": [[i,j,k,…], …] counter-clockwise from outside}; either may
///   have "density" (kg/m³). An id is text or a whole number, and occurs once.
/// - a compas assembly, as compas_assembly and compas_cra write it: blocks are the meshes in
///   data.graph.data.node.KEY.block.data, named by KEY, in the order of the keys; "is_support" of a node is heeded.
///
/// Throws InputError (file, field, found, expected).
Assembly read_assembly(const std::filesystem::path& path);
/// The same for text in memory; `name` stands for the file.
Assembly read_assembly_in_memory(const std::string& text, const std::string& name);

}  // namespace unseen::io
