// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Any file or folder that unseen reads → one page with pictures. Usage: 02_report CLOUD PAGE.html
#include <unseen/core/error.h>
#include <unseen/io/output_folder.h>
#include <unseen/io/points.h>
#include <unseen/planes/planes.h>
#include <unseen/report/page.h>
#include <unseen/report/planes_scene.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 02_report CLOUD PAGE.html\n");
    return 2;
  }
  const auto source = unseen::io::open_points(argv[1]);
  unseen::planes::Options options;
  unseen::Context context;
  context.on_message = [](std::string_view text) {
    std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
  };

  // The points pass by block after block; the page shows a sample of them.
  unseen::report::PointSample sample;
  const unseen::planes::Arrangement found = unseen::planes::find_planes(
      *source, options, context,
      [&](std::span<const unseen::Vec3> positions, std::span<const int> plane_of_point) {
        sample.add(positions, plane_of_point);
      });

  const unseen::report::InputRecord input = {argv[1], ""};
  const std::string scene =
      unseen::report::planes_scene(found, input, unseen::planes::describe(options), "02_report", sample);
  unseen::io::write_file_atomically(argv[2], unseen::report::page_of(unseen::report::planes_title(found, input), {scene}));
  std::printf("%zu planes in %zu frames: %s\n", found.planes.size(), found.frames.size(), argv[2]);
  return 0;
} catch (const unseen::InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 3;
}
