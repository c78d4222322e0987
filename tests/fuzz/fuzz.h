// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/error.h"
#include "unseen/io/mesh.h"
#include "unseen/io/points.h"

namespace unseen::io {

/// Reads points twice; whatever the bytes, that gives points or an InputError.
inline void fuzz_points(std::string bytes, const std::string& name) {
  try {
    ReadOptions options;
    options.mesh_samples = 10;
    const auto source = open_points_in_memory(std::move(bytes), name, options);
    PointCloud block;
    for (int pass = 0; pass < 2; ++pass) {
      source->rewind();
      while (source->next(block)) {
      }
    }
  } catch (const InputError&) {
  }
}

inline void fuzz_mesh(std::string bytes, const std::string& name) {
  try {
    read_mesh_in_memory(std::move(bytes), name);
  } catch (const InputError&) {
  }
}

}  // namespace unseen::io
