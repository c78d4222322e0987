// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/core/mesh.h"
#include "unseen/cuboids/photo_edit.h"
#include "unseen/cuboids/retrieval.h"
#include "unseen/cuboids/scan_completion.h"

namespace unseen::report {

/// Reads an EDITS.json (docs/formats.md): {"edits": [{"id": 3, "remove": true}, {"id": 4, "move": [dx, dy, dz],
/// "turn_deg": 30}]}. An edit removes, or moves (m, world) and turns about up; `source` names the text in messages.
/// Throws InputError (source, field, found, expected), also for keys that it does not know.
std::vector<cuboids::PhotoEdit> parse_photo_edits(const std::string& text, const std::string& source);

/// completed.json: where the model came to stand, and which of its boxes are which cuboids.
std::string scan_completion_json(const cuboids::ScanCompletion& completion, const std::string& model);

/// retrieved.json: the cuboids of the structure and the models, best first, with scores and transforms.
std::string retrieval_json(const cuboids::Retrieval& retrieval, const std::vector<cuboids::RetrievalModel>& models);

/// A mesh as PLY in text.
std::string mesh_ply(const TriangleMesh& mesh);

}  // namespace unseen::report
