// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "unseen/core/error.h"

namespace unseen::io {
namespace {

struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

}  // namespace

std::shared_ptr<FileBytes> FileBytes::open(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& found) {
    throw InputError(path.string(), "file", found, "a readable file");
  };
  // Without O_NONBLOCK opening a pipe would wait for its other end.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (file.value < 0 || ::fstat(file.value, &status) != 0) fail(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail("a folder");
  if (!S_ISREG(status.st_mode)) fail("a device or pipe");
  std::shared_ptr<FileBytes> bytes(new FileBytes);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return bytes;
  void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.value, 0);
  if (data == MAP_FAILED) fail(std::strerror(errno));
  ::madvise(data, size, MADV_SEQUENTIAL);
  bytes->view_ = {static_cast<const char*>(data), size};
  bytes->mapped_ = true;
  return bytes;
}

std::shared_ptr<FileBytes> FileBytes::own(std::string bytes) {
  std::shared_ptr<FileBytes> result(new FileBytes);
  result->owned_ = std::move(bytes);
  result->view_ = result->owned_;
  return result;
}

FileBytes::~FileBytes() {
  if (mapped_) ::munmap(const_cast<char*>(view_.data()), view_.size());
}

void FileBytes::release_before(std::size_t offset) {
  constexpr std::size_t kChunk = std::size_t{16} << 20;
  if (!mapped_) return;
  if (offset < released_) released_ = 0;  // read again from the start
  const std::size_t end = offset / kChunk * kChunk;
  if (end <= released_) return;
  ::madvise(const_cast<char*>(view_.data()) + released_, end - released_, MADV_DONTNEED);
  released_ = end;
}

}  // namespace unseen::io
