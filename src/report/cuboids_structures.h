// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "report/cuboid_parts.h"
#include "report/scene_builder.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::report {

/// A contact as one reads it: `from` carries or holds `to`.
struct CarriedContact {
  std::size_t from = 0, to = 0;  ///< supports first, then cuboids
  Vec3 force = Vec3::Zero();     ///< N, on `to`, of all its points together
};
/// In the order of the contacts: turned so that the force on `to` points up.
std::vector<CarriedContact> carried_contacts(const cuboids::Completion& completion);

/// "18.2 N, touching", or "fixed".
std::string name_of(const cuboids::Contact& contact, const CarriedContact& carried);

/// Each adds one structure of a cuboids result to a scene (docs/scene.md).
void add_boxes(SceneBuilder& scene, const cuboids::Completion& completion);
void add_contact_graph(SceneBuilder& scene, const cuboids::Completion& completion);
void add_supports(SceneBuilder& scene, const cuboids::Completion& completion);
void add_depth(SceneBuilder& scene, const cuboids::Completion& completion, const DepthPoints& points);
/// The camera of a depth image, with its photograph if there is one.
void add_camera(SceneBuilder& scene, const cuboids::Completion& completion, const RgbdFrame& frame);

}  // namespace unseen::report
