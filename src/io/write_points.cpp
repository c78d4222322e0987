// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/write_points.h"

#include "io/text.h"
#include "io/writers.h"
#include "unseen/core/error.h"
#include "unseen/io/output_folder.h"

namespace unseen::io {
namespace {

using Writer = void (*)(const Output&);

Writer writer_of(const std::filesystem::path& path) {
  const std::string extension = lower(path.extension().string());
  for (const auto& [known, writer] : {std::pair<const char*, Writer>{".ply", write_ply},
                                      {".pcd", write_pcd},
                                      {".xyz", write_xyz},
                                      {".txt", write_xyz},
                                      {".csv", write_csv},
                                      {".las", write_las}})
    if (extension == known) return writer;
  throw InputError(path.string(), "ending", shown(extension), ".ply, .pcd, .xyz, .txt, .csv or .las");
}

}  // namespace

void write_points(const std::filesystem::path& path, PointSource& source, Context& context) {
  const Writer writer = writer_of(path);
  AtomicFile file(path);
  PointCloud block;
  source.rewind();
  if (!source.next(block)) throw InputError(source.info().name, "content", "no points", "points");
  const Attributes has{!block.normals.empty(), !block.colors.empty(), !block.labels.empty()};
  writer({file.path(), source, has, context});
  file.commit();
}

}  // namespace unseen::io
