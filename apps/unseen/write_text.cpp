// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "write_text.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "unseen/core/error.h"

namespace unseen::cli {

void write_text(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw InputError(path.string(), "", std::generic_category().message(errno), "a file that can be written");
}

}  // namespace unseen::cli
