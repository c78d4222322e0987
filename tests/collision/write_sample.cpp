// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// write_sample DIR: the files of a made-up box that meets a ball (DIR/two) and of a ball that bounces (DIR/bounces), for tests/exchange.
#include <filesystem>
#include <fstream>

#include "collision/sample.h"
#include "unseen/collision/options.h"
#include "unseen/report/collision_files.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_scene.h"
#include "unseen/report/page.h"

namespace {

using namespace unseen;

void write(const std::filesystem::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

void write_folder(const std::filesystem::path& folder, const collision::Sample& s) {
  std::filesystem::create_directories(folder);
  collision::Options options;
  const OptionTable table = collision::describe(options);
  const report::InputRecord input = {"shot.json", std::string(64, '0')};
  write(folder / "result.json", report::collision_json(s.result, input, table));
  write(folder / "scene.glb", report::collision_glb(s.shot, s.result));
  write(folder / "report.html", report::page_of(report::collision_title(input), {report::collision_scene(s.result, input, table, "unseen collision shot.json -o out", s.shot, {})}));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  write_folder(std::filesystem::path(argv[1]) / "two", collision::sample_two_bodies());
  write_folder(std::filesystem::path(argv[1]) / "bounces", collision::sample_bounces());
}
