// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Bytes are the text of a shot file, or if they begin with "[" of its sightings, beside v.mp4 and tetra.obj.
#include <stdlib.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "unseen/core/error.h"
#include "unseen/report/collision_shot.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "unseen-fuzz-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path = pattern;
    write("v.mp4", "a video");
    write("tetra.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  fs::path path;
};

bool is_unit(const Vec3& v) { return std::abs(v.norm() - 1.0) < 1e-9; }

/// Whatever the text, that gives a shot that a solver can rely on, or an InputError.
void read(const Folder& folder, std::string_view text) {
  folder.write("shot.json", text);
  try {
    const collision::Shot s = read_shot(folder.path / "shot.json");
    bool good = s.bodies.size() == 2 && s.bodies[0].shape != collision::Shape::fixed && s.video.empty() != s.observations.empty();
    good = good && (s.camera.camera.fx > 0 || s.camera.hfov) && (!s.fps || *s.fps > 0) && std::isfinite(s.gravity);
    good = good && (!s.down || is_unit(*s.down)) && (!s.floor || (is_unit(s.floor->normal) && std::isfinite(s.floor->offset)));
    for (const collision::Sighting& x : s.observations) good = good && x.pixel.allFinite() && x.frame >= 0 && x.body < 2;
    for (const collision::OrientationHint& o : s.orientations) good = good && std::isfinite(o.time) && std::abs(o.q.norm() - 1.0) < 1e-9;
    if (!good) std::abort();
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace unseen::report

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace unseen::report;
  static const Folder folder;
  const std::string bytes(data, data + size);
  if (bytes.find('/') != std::string::npos) return 0;  // names no file elsewhere
  if (bytes.empty() || bytes[0] != '[') {
    read(folder, bytes);
    return 0;
  }
  folder.write("obs.json", bytes);
  read(folder, R"({"observations": "obs.json", "fps": 100, "camera": {"fx": 500, "fy": 500, "cx": 320, "cy": 240},
    "bodies": [{"name": "ball", "sphere": 0.05}, {"name": "floor", "fixed": true}]})");
  return 0;
}
