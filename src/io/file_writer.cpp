// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/file_writer.h"

#include <cerrno>
#include <cstring>

#include "unseen/core/error.h"

namespace unseen::io {

FileWriter::FileWriter(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) fail();
  std::setvbuf(file_, nullptr, _IOFBF, std::size_t{1} << 20);
}

FileWriter::~FileWriter() {
  if (file_) std::fclose(file_);
}

void FileWriter::fail() const {
  throw InputError(path_.string(), "output", std::strerror(errno), "a writable file");
}

void FileWriter::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
}

void FileWriter::patch(std::size_t offset, std::string_view bytes) {
  if (std::fseek(file_, static_cast<long>(offset), SEEK_SET) != 0) fail();
  write(bytes);
  if (std::fseek(file_, 0, SEEK_END) != 0) fail();
}

void FileWriter::close() {
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail();
}

}  // namespace unseen::io
