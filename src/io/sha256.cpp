// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/sha256.h"

#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "io/file_bytes.h"
#include "io/output_place.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

class Digest {
 public:
  Digest() : state_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!state_ || EVP_DigestInit_ex(state_.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(state_.get(), bytes.data(), bytes.size()); }
  std::string hex() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    EVP_DigestFinal_ex(state_.get(), digest, &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[digest[i] >> 4];
      text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> state_;
};

/// Reports progress from `done` to `done + share` of the whole.
std::string file_digest(const fs::path& path, const Context& context, double done, double share) {
  constexpr std::size_t kChunk = std::size_t{4} << 20;
  const auto bytes = FileBytes::open(path);
  const std::string_view all = bytes->view();
  Digest digest;
  for (std::size_t at = 0; at < all.size(); at += kChunk) {
    context.progress(done + share * static_cast<double>(at) / static_cast<double>(all.size()));
    digest.add(all.substr(at, kChunk));
    bytes->release_before(at);
  }
  return digest.hex();
}

}  // namespace

std::string sha256(const fs::path& path, const Context& context) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return file_digest(path, context, 0.0, 1.0);
  std::vector<fs::path> files;
  try {
    const auto results = result_files(path);  // no input
    for (const auto& entry : fs::directory_iterator(path)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && name.front() != '.' && results.count(name) == 0) files.push_back(entry.path());
    }
  } catch (const fs::filesystem_error& fault) {
    throw InputError(path.string(), "folder", fault.code().message(), "a readable folder");
  }
  std::sort(files.begin(), files.end());
  Digest digest;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(files.size(), 1));
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (::access(files[i].c_str(), R_OK) != 0) continue;  // nor could it be read as input
    digest.add(file_digest(files[i], context, share * static_cast<double>(i), share) + "  " + files[i].filename().string() + "\n");
  }
  return digest.hex();
}

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hex();
}

}  // namespace unseen::io
