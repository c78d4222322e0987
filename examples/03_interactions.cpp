// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What a pose network saw → furniture, and where everybody's pelvis went. Usage: 03_interactions TAKE.json SCENE.glb
#include <unseen/core/error.h>
#include <unseen/interactions/interactions.h>
#include <unseen/io/output_folder.h>
#include <unseen/report/interactions_files.h>
#include <unseen/report/interactions_take.h>
#include <unseen/report/scenelets_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 03_interactions TAKE.json SCENE.glb\n");
    return 2;
  }
  const unseen::interactions::Take take = unseen::report::read_take(argv[1]);
  unseen::Context context;
  const unseen::interactions::Reconstruction scene =
      unseen::interactions::reconstruct({take}, unseen::report::shipped_database(), {}, context);

  // World: z up, floor z = 0, the camera above the origin looking along +y.
  for (const unseen::interactions::FoundObject& found : scene.objects) {
    const unseen::Vec3 center = found.object.center();
    std::printf("%-6s at %6.2f %6.2f m, confidence %.2f, %zu parts\n", found.object.category.c_str(), center.x(), center.y(),
                found.confidence, found.object.parts.size());
  }
  for (const unseen::interactions::Person& person : scene.people) {
    double path = 0;
    for (std::size_t i = 1; i < person.frames.size(); ++i)
      path += (person.frames[i].pose - person.frames[i - 1].pose).col(unseen::interactions::pelvis).norm();
    std::printf("person %d: %zu frames, %.1f m\n", person.id, person.frames.size(), path);
  }
  unseen::io::write_file_atomically(argv[2], unseen::report::interactions_glb(scene));
  return scene.objects.empty() ? 4 : 0;
} catch (const unseen::InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 3;
}
