// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/photo_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cuboids/applications/inpaint.h"
#include "cuboids/applications/photo_render.h"
#include "cuboids/applications/photo_scene.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr double kOcclusionSigmas = 3.0, kOcclusionTolerance = 0.015;  // m
constexpr double kRimOpacity = 0.6;                           // of foreground pixels beside background

void check(const RgbdFrame& frame, const std::vector<PhotoEdit>& edits) {
  if (frame.is_fused()) throw InputError(frame.name, "cloud", "a fused cloud", "a frame with a photograph, to edit it");
  if (frame.color.size() != frame.depth.size() || frame.color.empty())
    throw InputError(frame.name, "color", fmt::format("{} pixels", frame.color.size()),
                     fmt::format("a photograph of {} pixels, to edit it", frame.depth.size()));
  for (std::size_t e = 0; e < edits.size(); ++e)
    if (!edits[e].move.allFinite() || !std::isfinite(edits[e].turn))
      throw InputError("edits", fmt::format("edits[{}]", e), "a number that is not finite", "finite numbers");
}

/// Says which cuboids lose what they stand on.
void warn_of_floating(const Completion& scene, const std::vector<EditedBody>& bodies, const PhotoScene& photo, Context& context) {
  std::map<int, int> index;
  for (std::size_t c = 0; c < scene.cuboids.size(); ++c) index[scene.cuboids[c].id] = static_cast<int>(c);
  for (const Contact& contact : scene.contacts) {
    if (contact.kind != ContactKind::touching || std::abs(contact.direction.z()) < 0.5) continue;
    const int below = contact.direction.z() > 0.0 ? contact.a : contact.b, above = below == contact.a ? contact.b : contact.a;
    const bool moves = std::any_of(bodies.begin(), bodies.end(), [&](const EditedBody& body) {
      return index.contains(below) && std::find(body.cuboids.begin(), body.cuboids.end(), index[below]) != body.cuboids.end();
    });
    if (moves && index.contains(above) && !photo.edited[index[above]])
      context.warn(fmt::format("box {} stood on {}, which is no longer there", above, below));
  }
}

/// Surfaces numbered from 0; −1 stays unknown, and what is none of them is a surface of its own.
std::vector<int> guide_of(const std::vector<int>& surface) {
  std::map<int, int> number;
  for (const int id : surface)
    if (id != -1) number.try_emplace(id, static_cast<int>(number.size()));
  std::vector<int> guide;
  for (const int id : surface) guide.push_back(id == -1 ? -1 : number[id]);
  return guide;
}

Color mixed(const Color& under, const Color& over, double share) {
  Color out;
  for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(std::lround((1.0 - share) * under[k] + share * over[k]));
  return out;
}

/// Lays the foreground over the picture where nothing is before it.
void composite(const Foreground& front, const PhotoScene& photo, const Completion& scene, const PhotoEditOptions& options,
               EditedPhoto& out) {
  const auto visible = [&](int i) {
    const double depth = front.depth[i], tolerance = kOcclusionTolerance + kOcclusionSigmas * options.noise * depth * depth;
    return front.cuboid[i] >= 0 && depth < photo.background[i] + tolerance;
  };
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int i = y * out.width + x;
      if (!visible(i)) continue;
      const bool rim = (x > 0 && front.cuboid[i - 1] < 0) || (x + 1 < out.width && front.cuboid[i + 1] < 0) ||
                       (y > 0 && front.cuboid[i - out.width] < 0) || (y + 1 < out.height && front.cuboid[i + out.width] < 0);
      out.pixels[i] = mixed(out.pixels[i], front.color[i], rim ? kRimOpacity : 1.0);
      out.shown[i] = scene.cuboids[front.cuboid[i]].id;
      out.shadow[i] = 0.0f;
    }
}

}  // namespace

EditedPhoto edit_photo(const RgbdFrame& frame, const Completion& scene, const std::vector<PhotoEdit>& edits,
                       const PhotoEditOptions& options, Context& context) {
  check(frame, edits);
  const std::vector<EditedBody> bodies = bodies_of(edits, scene);
  const PhotoScene photo = photo_scene(frame, scene, bodies, options, context);
  warn_of_floating(scene, bodies, photo, context);

  EditedPhoto out;
  out.width = frame.camera.width;
  out.height = frame.camera.height;
  out.hole = photo.hole;
  out.shown.assign(frame.depth.size(), -1);
  out.pixels = inpaint({out.width, out.height, frame.color, photo.hole, guide_of(photo.surface)}, options.seed, context);
  out.shadow = shadow_of_moved(frame, scene, bodies, photo, context);
  const std::vector<Color> lit = out.pixels;
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    if (out.shadow[i] > 0.0f) out.pixels[i] = mixed(lit[i], {0, 0, 0}, options.shadow * out.shadow[i]);
  composite(render_moved(frame, scene, bodies, photo, options, context), photo, scene, options, out);
  return out;
}

}  // namespace unseen::cuboids
