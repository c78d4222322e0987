// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/synth.h"

namespace unseen::cuboids {

/// A generated view with its masks, as the program would read it, but for the rounding of files.
inline RgbdFrame frame_of(const SynthView& view) {
  RgbdFrame frame;
  frame.name = view.truth.family;
  frame.camera = view.camera;
  frame.depth = view.depth;
  frame.color = view.color;
  frame.masks.assign(view.masks.begin(), view.masks.end());
  return frame;
}

/// One view of a family.
inline SynthView view_of(const std::string& family, int number, int boxes = 0) {
  SynthOptions options;
  options.scene = family;
  options.view = number;
  options.boxes = boxes;
  Context context;
  return make_scene(options, context).views.front();
}

}  // namespace unseen::cuboids
