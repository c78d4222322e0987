// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/codecs.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace unseen::io {
namespace {

/// Beside the program that runs, as built or installed; where a user's own program looks for libraries; where it was built.
const Codecs& load() {
  namespace fs = std::filesystem;
  const fs::path name = "unseen_codecs.so", modules = UNSEEN_MODULES, built = UNSEEN_BUILT;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error), folder = error ? built : program.parent_path();
  for (const fs::path& place : {folder / modules / name, name, built / modules / name})
    if (void* module = ::dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (const void* found = ::dlsym(module, "unseen_codecs")) return *static_cast<const Codecs*>(found);
  throw std::runtime_error("cannot load " + (folder / modules / name).string() + ", which reads and writes JPEG, TIFF and video: " + ::dlerror());
}

}  // namespace

const Codecs& codecs() {
  static const Codecs& loaded = load();
  return loaded;
}

}  // namespace unseen::io
