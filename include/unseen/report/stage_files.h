// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "unseen/collision/stage.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// Reads a shot list (TOML, docs/formats.md) with the results and shots that it names; paths are relative to its folder. Throws
/// InputError (file, field, found, expected), also for fields that it does not know.
collision::StagePlan read_stage_list(const std::filesystem::path& path);

/// Results of `unseen collision` (folders or their result.json) side by side along x, their impacts at the same time.
collision::StagePlan stage_side_by_side(const std::vector<std::string>& results);

/// "actor-0.obj": the mesh of an actor, about its centre of mass. Only for actors that are meshes.
std::string actor_file(const collision::StagedShot& shot, std::size_t actor);
std::string actor_obj(const collision::StagedShot& shot, std::size_t actor);

/// result.json of `unseen stage` (docs/formats.md, docs/schema/stage.schema.json): bodies, impacts, poses at each frame.
std::string stage_json(const collision::StagedShot& shot, const InputRecord& input);

/// Reads such a file back, with the meshes beside it. Velocities of `frames` are not stored and come back as 0. Throws InputError naming
/// file and field.
collision::StagedShot read_stage_result(const std::filesystem::path& path);

/// The shot as a scene of the page (docs/scene.md); `command` made it.
std::string stage_scene(const collision::StagedShot& shot, const InputRecord& input, const std::string& command);

/// "Shot staged from list.toml"
std::string stage_title(const InputRecord& input);

/// scene.glb as that of a collision, with the camera of the first one.
std::string stage_glb(const collision::StagedShot& shot);

/// The same animation as USD ASCII: a time code a frame.
std::string stage_usda(const collision::StagedShot& shot);

}  // namespace unseen::report
