// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>

#include "interactions/result_samples.h"
#include "interactions/scene_samples.h"
#include "interactions/take_samples.h"
#include "unseen/core/error.h"
#include "unseen/interactions/evaluate.h"
#include "unseen/report/interactions_recording.h"
#include "unseen/report/interactions_take.h"

namespace unseen::interactions::test {
namespace {

/// Some bytes replaced, cut off, repeated, or numbers made huge.
std::string mutate(std::string s, Random& random) {
  const std::size_t edits = 1 + random.index(3);
  for (std::size_t i = 0; i < edits && !s.empty(); ++i) {
    const std::size_t at = random.index(s.size());
    switch (random.index(6)) {
      case 0: s[at] = static_cast<char>(random.index(256)); break;
      case 1: s[at] = "0123456789-.,:[]{}\"en"[random.index(21)]; break;
      case 2: if (random.index(4) == 0) s.resize(at); break;
      case 3: s.insert(at, s, random.index(s.size()), random.index(20)); break;
      case 4: s.erase(at, random.index(20)); break;
      default: s.insert(at, random.index(2) == 0 ? "9e99" : "-7"); break;
    }
  }
  return s;
}

/// Runs `read` on mutations of the files; whatever they are, it gives a value or an InputError of one line. How often a value.
int read_mutations(const Folder& folder, const std::map<std::string, std::string>& files, int times, const std::function<void()>& read) {
  Random random(13);
  int well = 0;
  for (int i = 0; i < times; ++i) {
    const auto& [name, text] = *std::next(files.begin(), static_cast<std::ptrdiff_t>(i % static_cast<int>(files.size())));
    folder.write(name, mutate(text, random));
    try {
      read();
      ++well;
    } catch (const InputError& e) {
      EXPECT_EQ(std::count(e.what(), e.what() + std::char_traits<char>::length(e.what()), '\n'), 0) << e.what();
    }
    folder.write(name, text);
  }
  return well;
}

TEST(Mutations, OfTakesGiveATakeOrAnInputError) {
  const Folder folder;
  const std::map<std::string, std::map<std::string, std::string>> kinds = {
      {"openpose", {{"joints/1.json", openpose_frame(Json::array({openpose_person(kBody25)})).dump()}, {"joints/2.json", openpose_frame(Json::array({openpose_person(kCoco18, 9)})).dump()}}},
      {"coco", {{"coco.json", Json{coco_person(1), coco_person(2)}.dump()}}},
      {"mediapipe", {{"mediapipe.json", Json{{{"landmarks", landmarks()}, {"world_landmarks", landmarks(0, true)}}}.dump()}}},
      {"i3db", {{"skel_a_2d_00.json", i3db_detections({1, 2}, 0.5, true).dump()}}}};
  const std::map<std::string, std::string> places = {{"openpose", "joints"}, {"coco", "coco.json"}, {"mediapipe", "mediapipe.json"}, {"i3db", "."}};
  for (const auto& [format, files] : kinds) {
    std::map<std::string, std::string> all = files;
    const std::string name = "take-" + format + ".json";
    all[name] = take(format, places.at(format)).dump();
    for (const auto& [file, text] : all) folder.write(file, text);
    const int well = read_mutations(folder, all, 400, [&] { (void)report::read_take(folder.path() / name); });
    EXPECT_GT(well, 20) << format;
    EXPECT_LT(well, 380) << format;
  }
}

TEST(Mutations, OfScenesGiveARecordingOrAnInputError) {
  const Folder folder;
  Recording truth = sample_recording();
  for (auto& person : truth.people) person.resize(2);
  write_scene(folder, truth);
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    files[std::filesystem::relative(entry.path(), folder.path()).string()] = std::string(std::istreambuf_iterator<char>(in), {});
  }
  const int well = read_mutations(folder, files, 1500, [&] { (void)report::read_recording(folder.path()); });
  EXPECT_GT(well, 100);
  EXPECT_LT(well, 1400);
}

TEST(Mutations, OfResultsGiveAResultThatCanBeEvaluatedOrAnInputError) {
  const Folder folder;
  const std::map<std::string, std::string> files = {{"result.json", result_text(sample_result())}};
  const Recording truth = sample_recording();
  const int well = read_mutations(folder, files, 800, [&] { (void)evaluate(report::read_interactions_result(folder.path() / "result.json"), truth); });
  EXPECT_GT(well, 20);
  EXPECT_LT(well, 780);
}

}  // namespace
}  // namespace unseen::interactions::test
