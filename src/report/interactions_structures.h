// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "report/scene_builder.h"
#include "unseen/interactions/types.h"

namespace unseen::report {

/// "chair 0"
std::string name_of(const interactions::FoundObject& object);
/// "person 0"
std::string name_of(const interactions::Person& person);
/// The label whose colour a person has, by its place in the list; superclasses have the first four.
int person_label(std::size_t index);

/// Everything that is drawn of people and objects; empty if there is neither.
Eigen::AlignedBox3d reach_of(const interactions::Reconstruction& r);

/// The parts of an interactions page (docs/scene.md), each a structure.
void add_floor(SceneBuilder& scene, const interactions::Reconstruction& r);
/// A picture that lies on the floor once it is switched on.
void add_evidence(SceneBuilder& scene, const interactions::EvidenceMap& map, const std::string& png, int pixels_per_cell);
void add_objects(SceneBuilder& scene, const interactions::Reconstruction& r);
void add_people(SceneBuilder& scene, const interactions::Reconstruction& r);
/// A segment of the pelvis path between two neighbouring frames.
void add_paths(SceneBuilder& scene, const interactions::Reconstruction& r);
void add_camera(SceneBuilder& scene, const interactions::Reconstruction& r);
/// What the detector saw, drawn on the picture of the camera.
void add_detections(SceneBuilder& scene, const interactions::Reconstruction& r, const interactions::Take& take);
/// The curve of a person, and the windows; those that prove an object speak for it.
void add_likelihood_chart(SceneBuilder& scene, const interactions::Reconstruction& r);

}  // namespace unseen::report
