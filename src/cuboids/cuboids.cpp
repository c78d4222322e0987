// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/cuboids.h"

#include "cuboids/objects/cuts.h"
#include "cuboids/search/complete.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/observation.h"
#include "cuboids/surfaces/smear.h"

namespace unseen::cuboids {
namespace {

/// Boxes around what is visible, and the world that they are in.
void perceive(const RgbdFrame& frame, const Options& options, Context& context, Completion& result) {
  Summary& summary = result.summary;
  Observation seen;
  {
    const Stage stage(context, summary, "supports");
    seen = observe(frame, options, context);
    result.T_world_camera = seen.T_world_camera;
    result.supports = seen.supports;
    summary.counts.emplace_back("points", seen.points.size());
  }
  const DepthView view(frame, result.T_world_camera, depth_noise(frame, options));
  std::vector<ObjectPart> parts;
  {
    const Stage stage(context, summary, "objects");
    parts = cut_parts(seen, view, find_objects(frame, seen, options, context), context);
    summary.counts.emplace_back("parts", parts.size());
  }
  {
    const Stage stage(context, summary, "boxes");
    result.cuboids = fit_cuboids(frame, seen, parts, view, options, context);
  }
  if (options.image_edges && !frame.color.empty()) {
    const Stage stage(context, summary, "edges");
    align_to_image_edges(frame, seen, view, result.cuboids, options, context);
  }
}

}  // namespace

Completion complete_cuboids(const RgbdFrame& frame, const Options& options, Context& context) {
  check_options(options);
  return run_cuboids(context, {}, [&](Completion& result) {
    const std::optional<RgbdFrame> sharp = without_smear(frame, context);
    const RgbdFrame& seen = sharp ? *sharp : frame;
    const Options exact = with_depth_noise(seen, options, context);
    perceive(seen, exact, context, result);
    complete_boxes(seen, exact, context, result);
  });
}

}  // namespace unseen::cuboids
