// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "unseen/core/mesh.h"
#include "unseen/core/point_cloud.h"

namespace unseen::io {

/// Reads OBJ, OFF, STL (text and binary) or PLY with faces. Polygons are cut into triangles; triangles
/// without area, or with a corner that is not finite, are left out. The groups of an OBJ (g or o, if there
/// are two or more) become labels, numbered from 0 as they appear; an integer property of PLY faces named
/// label, segment_index, plane or class does too. Coordinates keep double precision. Vertices stay as the
/// file has them (an STL repeats those that triangles share). A mesh without triangles is no error. Throws
/// InputError (file, field, found, expected).
TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same for the bytes of one file in memory; `name` stands for the file, ending included.
TriangleMesh read_mesh_in_memory(std::string bytes, const std::string& name);

/// `count` points uniformly distributed over the surface, with the normal and the label of their triangle.
/// The same mesh, count and seed give the same points. Empty if the mesh has no area.
PointCloud sample_mesh(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace unseen::io
