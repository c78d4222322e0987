// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/add_to_result.h"

#include <fstream>
#include <iterator>

#include "unseen/io/output_folder.h"

namespace unseen::io {

void add_to_result(const std::filesystem::path& folder, const std::string& name, std::string_view bytes) {
  const std::filesystem::path list = folder / ".unseen-files";  // as OutputFolder keeps it
  if (std::filesystem::is_regular_file(std::filesystem::symlink_status(list))) {
    std::ifstream file(list, std::ios::binary);
    std::string names((std::istreambuf_iterator<char>(file)), {});
    if (("\n" + names).find("\n" + name + "\n") == std::string::npos)
      write_file_atomically(list, names + name + "\n");
  }
  write_file_atomically(folder / name, bytes);
}

}  // namespace unseen::io
