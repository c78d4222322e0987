// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/mesh.h"
#include "unseen/core/point_cloud.h"
#include "unseen/io/points.h"
#include "unseen/planes/synth.h"

namespace unseen::bench {

/// One input of the comparison: a file with its scale and truth, or a generated scene.
struct Case {
  std::string name;
  double scale = 0;                   ///< m
  std::filesystem::path file, truth;  ///< truth: a mesh, may be empty
  bool labels = false;                ///< the file's labels are the truth of a segmentation
  std::vector<double> angles = {90};  ///< deg
  io::ReadOptions read;
  std::optional<planes::SynthOptions> synth;
};

/// Reads a list: one case a line, `name key=value …` with keys file, truth, scale, angles, label_field,
/// frame_step, depth_step, or `synth=SCENE` with any option of it; # starts a comment. Paths are relative to
/// `data`. Throws InputError with the line's number.
std::vector<Case> read_cases(const std::filesystem::path& list, const std::filesystem::path& data);

/// A case in memory.
struct Loaded {
  PointCloud cloud;
  TriangleMesh truth;
  std::optional<planes::SynthScene> scene;  ///< without its cloud and mesh
};
Loaded load(const Case& c);

}  // namespace unseen::bench
