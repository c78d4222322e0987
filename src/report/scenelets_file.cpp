// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/scenelets_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstring>

#include "io/bytes_out.h"
#include "io/file_bytes.h"
#include "io/json_field.h"
#include "report/json_write.h"
#include "report/scenelets_pack.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr std::string_view kMagic = "unseenSC";
constexpr std::uint32_t kFormatVersion = 1;
constexpr std::size_t kPrefix = 8 + 4 * sizeof(std::uint32_t);
constexpr std::size_t kMostBody = std::size_t{1} << 30;
constexpr std::size_t kMostPacking = 1040;  ///< zlib makes nothing smaller than by this factor

Json header_of(const Database& database) {
  Json header;
  header["recordings"] = list_of(database.recordings, [](const Source& s, std::size_t) { return Json{{"name", s.name}, {"room", s.room}, {"licence", s.licence}}; });
  header["categories"] = kCategories;
  header["grid"] = kGrid;
  return header;
}

std::vector<Source> recordings_of(const std::string& text, const std::string& source) {
  const std::string kind = "a scenelet database";
  const nlohmann::json parsed = io::parse_json(text, source, kind);
  const io::JsonField json(parsed, source);
  if (json["grid"].count() != kGrid) json["grid"].fail(fmt::format("{}", kGrid));
  const std::vector<io::JsonField> categories = json["categories"].list();
  if (categories.size() != kCategories.size()) json["categories"].fail(fmt::format("{} categories", kCategories.size()));
  for (std::size_t i = 0; i < categories.size(); ++i)
    if (categories[i].text() != kCategories[i]) categories[i].fail(fmt::format("\"{}\"", kCategories[i]));
  std::vector<Source> recordings;
  for (const io::JsonField& entry : json["recordings"].list()) recordings.push_back({entry["name"].text(), entry["room"].text(), entry["licence"].text()});
  return recordings;
}

std::string packed(const std::string& body) {
  uLongf size = compressBound(static_cast<uLong>(body.size()));
  std::string bytes(size, '\0');
  compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(body.data()), static_cast<uLong>(body.size()), Z_BEST_COMPRESSION);
  bytes.resize(size);
  return bytes;
}

std::string unpacked(std::string_view bytes, std::size_t size, const std::string& source) {
  if (size > kMostBody || size > kMostPacking * (bytes.size() + 1)) throw InputError(source, "body", fmt::format("{} bytes once unpacked", size), "less, for what is there");
  std::string body(size, '\0');
  auto got = static_cast<uLongf>(size);
  const int outcome = uncompress(reinterpret_cast<Bytef*>(body.data()), &got, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  if (outcome != Z_OK || got != size) throw InputError(source, "body", "not what zlib packed", "a scenelet database");
  return body;
}

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

}  // namespace

std::string database_bytes(const Database& database) {
  const std::string body = body_of(pack(database), database);
  const std::string header = header_of(database).dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string rest = header + packed(body);
  std::string bytes(kMagic);
  for (const std::size_t number : {static_cast<std::size_t>(kFormatVersion), header.size(), body.size(), static_cast<std::size_t>(checksum(rest))})
    io::append_little(bytes, static_cast<std::uint32_t>(number));
  return bytes + rest;
}

Database parse_database(std::string_view bytes, const std::string& source) {
  const std::string kind = "a scenelet database of unseen scenelets build";
  if (bytes.substr(0, kMagic.size()) != kMagic) throw InputError(source, "", "another kind of file", kind);
  if (bytes.size() < kPrefix) throw InputError(source, "", fmt::format("{} bytes", bytes.size()), kind);
  if (const std::uint32_t version = number_at(bytes, 8); version != kFormatVersion)
    throw InputError(source, "version", fmt::format("{}", version), fmt::format("{}", kFormatVersion));
  const std::string_view rest = bytes.substr(kPrefix);
  const std::size_t header = number_at(bytes, 12), body = number_at(bytes, 16);
  if (rest.size() > std::numeric_limits<std::uint32_t>::max() || header > rest.size() || checksum(rest) != number_at(bytes, 20))
    throw InputError(source, "checksum", "another one", "that of a whole, undamaged file");
  Database database;
  database.recordings = recordings_of(std::string(rest.substr(0, header)), source);
  database.scenelets = scenelets_of(unpacked(rest.substr(header), body, source), database.recordings.size(), source);
  return database;
}

Database read_database(const std::filesystem::path& path) {
  const auto file = io::FileBytes::open(path);
  return parse_database(file->view(), path.string());
}

}  // namespace unseen::report
