// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/photo_edit.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A ray of the camera in world coordinates. The parameter of a point on it is its depth along the optical axis.
struct Ray {
  Vec3 origin, direction;
  Vec3 at(double depth) const { return origin + depth * direction; }
};
Ray ray_of_pixel(const Camera& camera, const RigidTransform& T_world_camera, double u, double v);

/// Where a ray enters and leaves a box, and the outward normal where it enters.
struct BoxHit {
  double enter = 0, leave = 0;
  Vec3 normal;
};
/// None if the ray misses the box or begins in it.
std::optional<BoxHit> hit_box(const Ray& ray, const OrientedBox& box);

/// The nearest surface of supports and boxes along a ray.
struct SurfaceHit {
  int id = -1;  ///< of the support or cuboid
  double depth = 0;
};
/// Leaves out the cuboids that are marked. Supports count within their outlines.
std::optional<SurfaceHit> nearest_surface(const Ray& ray, const Completion& scene, const std::vector<char>& left_out);

/// A body that is edited.
struct EditedBody {
  std::vector<int> cuboids;  ///< indices
  bool removed = false;
  RigidTransform motion;     ///< of the world's coordinates
};
/// Bodies of the edits, with all cuboids that are fixed to the named ones. Throws InputError.
std::vector<EditedBody> bodies_of(const std::vector<PhotoEdit>& edits, const Completion& scene);

/// What a photograph shows of the edited objects and of the rest.
struct PhotoScene {
  std::vector<char> edited;       ///< a cuboid, by index
  std::vector<int> owner;         ///< index of the cuboid whose pixel it is; −1 = none
  std::vector<char> hole;         ///< pixels of edited cuboids and a rim around them
  std::vector<float> background;  ///< m: depth without the edited cuboids; infinite where nothing is known
  std::vector<int> surface;       ///< id of what is seen without them; −1 = unknown, −2 = none of the scene's surfaces
};
PhotoScene photo_scene(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                       const PhotoEditOptions& options, const Context& context);

}  // namespace unseen::cuboids
