// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// write_sample FOLDER: the files of made-up results, for tests that other programs read.
#include <filesystem>
#include <fstream>

#include "interactions/page_sample.h"
#include "unseen/interactions/evidence_picture.h"
#include "unseen/interactions/options.h"
#include "unseen/io/write_png.h"
#include "unseen/report/interactions_files.h"
#include "unseen/report/interactions_result.h"
#include "unseen/report/interactions_scene.h"
#include "unseen/report/page.h"

namespace unseen::report {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_folder(const std::filesystem::path& folder, interactions::PageSample s) {
  std::filesystem::create_directories(folder);
  const InputRecord input = {"take.json", ""};
  interactions::Options options;
  const OptionTable table = interactions::describe(options);
  const interactions::EvidencePicture map = interactions::picture_of(s.result.evidence, kEvidencePixels);
  if (!map.pixels.empty()) io::write_color_png(folder / "evidence.png", map.width, map.height, map.pixels);
  write(folder / "result.json", interactions_json(s.result, input, table));
  write(folder / "scene.glb", interactions_glb(s.result));
  write(folder / "report.html", page_of(interactions_title(input), {interactions_scene(s.result, input, table, "unseen interactions take.json -o out",
                                                                                       {s.take}, read(folder / "evidence.png"))}));
  for (std::size_t p = 0; p < s.result.people.size(); ++p) write(folder / bvh_name(p), interactions_bvh(s.result.people[p], s.result.fps));
}

}  // namespace
}  // namespace unseen::report

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  unseen::report::write_folder(folder / "one", unseen::interactions::page_sample());
  unseen::report::write_folder(folder / "three", unseen::interactions::page_sample(3, 24, 5));
  unseen::report::write_folder(folder / "nothing", {});
}
