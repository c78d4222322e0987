// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "io/file_writer.h"
#include "io/output_place.h"
#include "unseen/core/error.h"
#include "unseen/io/output_folder.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& found) {
  throw InputError(path.string(), "output", found, "a file that can be written");
}

}  // namespace

fs::path resolved(const fs::path& path) {
  fs::path result = fs::weakly_canonical(fs::absolute(path));
  return result.has_filename() ? result : result.parent_path();
}

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  fs::path path;
  do {
    path = target.parent_path() /
           fmt::format(".{}.unseen-{}-{}", target.filename().string(), ::getpid(), counter++);
  } while (fs::exists(fs::symlink_status(path)));
  return path;
}

AtomicFile::AtomicFile(const fs::path& path) {
  try {
    target_ = resolved(path);
    fs::create_directories(target_.parent_path());
    if (fs::exists(target_)) {
      if (!fs::is_regular_file(target_)) fail(path, "a folder or device of that name");
      if (::access(target_.c_str(), W_OK) != 0) fail(path, "no permission to write");
    }
    temporary_ = temporary_beside(target_);
  } catch (const fs::filesystem_error& fault) {
    fail(path, fault.code().message());
  }
  const int file = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) fail(path, std::strerror(errno));
  ::close(file);
}

AtomicFile::~AtomicFile() {
  std::error_code error;
  if (!committed_) fs::remove(temporary_, error);
}

void AtomicFile::commit() {
  std::error_code error;
  if (fs::is_regular_file(target_, error))
    fs::permissions(temporary_, fs::status(target_).permissions(), error);
  fs::rename(temporary_, target_, error);
  if (error) fail(target_, error.message());
  committed_ = true;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  FileWriter writer(file.path());
  writer.write(bytes);
  writer.close();
  file.commit();
}

}  // namespace unseen::io
