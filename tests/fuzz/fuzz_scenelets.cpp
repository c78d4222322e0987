// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Bytes up to the first zero are the header's text of a database, those after it are its body before packing; sizes and checksum are made to fit.
#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/bytes_out.h"
#include "unseen/core/error.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::report {
namespace {

std::string packed(const std::string& body) {
  uLongf size = compressBound(static_cast<uLong>(body.size()));
  std::string bytes(size, '\0');
  compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(body.data()), static_cast<uLong>(body.size()), 1);
  bytes.resize(size);
  return bytes;
}

/// Whatever the bytes, that gives a database that can be written and read again, or an InputError.
void read(const std::string& bytes) {
  try {
    const interactions::Database database = parse_database(bytes, "fuzz");
    for (const interactions::Scenelet& s : database.scenelets) {
      bool good = s.recording >= 0 && s.recording < static_cast<int>(database.recordings.size()) && s.fps > 0 && !s.poses.empty();
      good = good && s.middle >= 0 && s.middle < static_cast<int>(s.poses.size()) && s.actions.size() == s.poses.size() && s.valid.size() == s.poses.size();
      for (const interactions::Pose& pose : s.poses) good = good && pose.allFinite();
      if (!good) std::abort();
    }
    if (parse_database(database_bytes(database), "again").scenelets.size() != database.scenelets.size()) std::abort();
  } catch (const InputError& e) {
    if (e.source == "again") std::abort();
  }
}

}  // namespace
}  // namespace unseen::report

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace unseen;
  const std::string bytes(data, data + size);
  report::read(bytes);
  const std::size_t middle = std::min(bytes.find('\0'), bytes.size());
  const std::string body = bytes.substr(std::min(middle + 1, bytes.size()));
  const std::string rest = bytes.substr(0, middle) + report::packed(body);
  std::string whole = "unseenSC";
  const auto sum = crc32(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(rest.data()), static_cast<uInt>(rest.size()));
  for (const std::size_t number : {std::size_t{1}, middle, body.size(), static_cast<std::size_t>(sum)}) io::append_little(whole, static_cast<std::uint32_t>(number));
  report::read(whole + rest);
  return 0;
}
