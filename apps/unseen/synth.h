// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "session.h"
#include "unseen/core/summary.h"
#include "unseen/io/output_folder.h"

namespace unseen::cli {

/// Ends a command that made a scene: commits the folder and prints the summary, or what `made` says and where it lies. Throws Cancelled.
void publish(Summary& summary, const std::string& made, io::OutputFolder& out, const std::string& folder, const CommonFlags& common, Session& session);

}  // namespace unseen::cli
