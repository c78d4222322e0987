// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "write_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
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

std::string read_text(const std::filesystem::path& path, std::size_t largest) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) throw InputError(path.string(), "", code.message(), "a file that can be read");
  if (size > largest) throw InputError(path.string(), "size", fmt::format("{} bytes", size), fmt::format("at most {} MB", largest / 1'000'000));
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace unseen::cli
