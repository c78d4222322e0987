// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>

#include "io/columns.h"
#include "unseen/core/context.h"

namespace unseen::io {

/// One writer a format; `path` is a temporary file, `has` what the source gives.
struct Output {
  const std::filesystem::path& path;
  PointSource& source;
  Attributes has;
  Context& context;
};

void write_ply(const Output& out);
void write_pcd(const Output& out);
void write_xyz(const Output& out);
void write_csv(const Output& out);
void write_las(const Output& out);

}  // namespace unseen::io
