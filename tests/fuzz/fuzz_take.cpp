// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The first byte says what the rest is: the text of a take file, beside joints of every format, or joints of one of the formats.
#include <stdlib.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "unseen/core/error.h"
#include "unseen/report/interactions_take.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScene = R"({"confidence_normalized": true, "3d": {"00001": {"0": [1,2,3]}}, "confidence": {}})";

struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "unseen-fuzz-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path = pattern;
    fs::create_directory(path / "frames");
    std::string keypoints, landmarks;
    for (int k = 0; k < 25; ++k) keypoints += (k ? "," : "") + std::to_string(100 + 7 * k) + "," + std::to_string(200 + 11 * k) + ",0.9";
    for (int k = 0; k < 33; ++k) landmarks += (k ? "," : "") + std::string("[0.") + std::to_string(10 + k) + ",0.5,0,0.9]";
    write("frames/a_000001.json", R"({"people": [{"pose_keypoints_2d": [)" + keypoints + "]}]}");
    write("coco.json", R"([{"image_id": 3, "keypoints": [)" + keypoints.substr(0, keypoints.find(",268")) + "]}]");
    write("mediapipe.json", R"([{"landmarks": [)" + landmarks + "]}]");
    write("skel_a_2d_00.json", kScene);
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  fs::path path;
};

/// Whatever the text, that gives a take that the method can rely on, or an InputError.
void read(const Folder& folder, std::string_view text) {
  folder.write("take.json", text);
  try {
    const interactions::Take t = read_take(folder.path / "take.json");
    bool good = !t.detections.empty() && t.people >= 1 && t.fps > 0 && std::isfinite(t.fps) && t.camera.fx > 0 && t.camera.fy > 0;
    good = good && t.camera.width > 0 && t.camera.height > 0 && std::isfinite(t.camera.cx) && std::isfinite(t.camera.cy);
    good = good && (!t.up || std::abs(t.up->norm() - 1.0) < 1e-9) && (!t.camera_height || *t.camera_height > 0);
    int frame = 0;
    for (const interactions::Detection& d : t.detections) {
      good = good && d.frame >= frame && d.person < t.people && d.pixels.allFinite() && (!d.local || d.local->allFinite());
      good = good && (d.confidence >= 0.0).all() && (d.confidence <= 1.0).all() && (d.confidence > 0.0).any();
      frame = d.frame;
    }
    for (const interactions::Label& l : t.labels) good = good && l.pixel.allFinite() && l.person >= 0 && l.person < t.people;
    if (!good) std::abort();
  } catch (const InputError&) {
  }
}

std::string take_of(const std::string& format, const std::string& joints) {
  return R"({"camera": {"hfov_deg": 50}, "people": 2, "format": ")" + format + R"(", "joints": ")" + joints + "\"}";
}

}  // namespace
}  // namespace unseen::report

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace unseen::report;
  static const Folder folder, scene;
  if (size == 0) return 0;
  const std::string rest(data + 1, data + size);
  switch (data[0]) {
    case 'o':
      folder.write("frames/a_000002.json", rest);
      read(folder, take_of("openpose", "frames"));
      break;
    case 'c':
      folder.write("other.json", rest);
      read(folder, take_of("coco", "other.json"));
      break;
    case 'm':
      folder.write("other.json", rest);
      read(folder, take_of("mediapipe", "other.json"));
      break;
    case 'i':
      scene.write("skel_a_2d_00.json", rest);
      read(scene, take_of("i3db", "."));
      break;
    default:
      if (rest.find('/') == std::string::npos) read(folder, rest);  // names no file elsewhere
  }
  return 0;
}
