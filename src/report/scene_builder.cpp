// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/scene_builder.h"

#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "unseen/core/version.h"

namespace unseen::report {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr int kCompression = 5;  // of zlib's 1…9

/// Component after component, each value less the one before it; of those the lowest bytes first, then the next.
template <class T>
std::string delta_bytes(std::span<const T> tuples, int components) {
  const std::size_t n = tuples.size();
  std::string bytes(n * sizeof(T), '\0');
  std::size_t at = 0;
  for (int c = 0; c < components; ++c) {
    T last = 0;
    for (std::size_t i = c; i < n; i += components, ++at) {
      const T delta = static_cast<T>(tuples[i] - last);
      last = tuples[i];
      for (std::size_t b = 0; b < sizeof(T); ++b) bytes[b * n + at] = static_cast<char>(delta >> (8 * b));
    }
  }
  return bytes;
}

std::string gzip(const std::string& data) {
  z_stream stream{};
  if (deflateInit2(&stream, kCompression, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib does not start");
  std::string packed(deflateBound(&stream, data.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  // zlib counts in 32 bits.
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  std::size_t left_in = data.size(), left_out = packed.size();
  int status = Z_OK;
  while (status == Z_OK) {
    const uInt in = static_cast<uInt>(std::min(left_in, kMost)), out = static_cast<uInt>(std::min(left_out, kMost));
    stream.avail_in = in;
    stream.avail_out = out;
    status = deflate(&stream, left_in == in ? Z_FINISH : Z_NO_FLUSH);
    left_in -= in - stream.avail_in;
    left_out -= out - stream.avail_out;
  }
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib does not finish");
  packed.resize(packed.size() - left_out);
  return packed;
}

std::string base64(const std::string& data) {
  constexpr std::size_t kChunk = 3 << 20;  // whole groups of three, so that the parts join
  std::string text;
  text.reserve((data.size() + 2) / 3 * 4);
  std::vector<unsigned char> part(kChunk / 3 * 4 + 1);
  for (std::size_t at = 0; at < data.size(); at += kChunk) {
    const std::size_t size = std::min(kChunk, data.size() - at);
    const int written = EVP_EncodeBlock(part.data(), reinterpret_cast<const unsigned char*>(data.data()) + at, static_cast<int>(size));
    text.append(reinterpret_cast<const char*>(part.data()), static_cast<std::size_t>(written));
  }
  return text;
}

void pad(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8, '\0'); }

}  // namespace

SceneBuilder::SceneBuilder(const Vec3& offset) : offset_(offset) {
  header = {{"scene", 1}, {"offset", vector_of(offset)}, {"flat", false}, {"structures", Json::array()}, {"tables", Json::array()}};
}

Json& SceneBuilder::add(std::string_view kind, std::string_view id, std::string_view name) {
  Json& list = header["structures"];
  list.push_back({{"id", id}, {"kind", kind}, {"name", name}, {"visible", true}, {"quantities", Json::array()}});
  return list.back();
}

Json SceneBuilder::describe(std::size_t count, int components, const char* type) const {
  return {{"offset", buffer_.size()}, {"count", count}, {"components", components}, {"type", type}};
}

void SceneBuilder::append(const void* data, std::size_t size) {
  buffer_.append(static_cast<const char*>(data), size);
  pad(buffer_);
}

Json SceneBuilder::point_positions(std::span<const Vec3> world) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : world) box.extend(p);
  if (world.empty()) box.extend(offset_);
  const Vec3 size = box.sizes();
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * world.size());
  for (const Vec3& p : world)
    for (int a = 0; a < 3; ++a)
      steps.push_back(size[a] > 0 ? static_cast<std::uint16_t>(std::lround((p[a] - box.min()[a]) / size[a] * 65535.0)) : 0);
  Json json = describe(world.size(), 3, "u16");
  json["encoding"] = "delta";
  json["low"] = vector_of(box.min() - offset_);
  json["high"] = vector_of(box.max() - offset_);
  const std::string bytes = delta_bytes<std::uint16_t>(steps, 3);
  append(bytes.data(), bytes.size());
  return json;
}

Json SceneBuilder::floats(std::span<const float> values, int components) {
  Json json = describe(values.size() / components, components, "f32");
  append(values.data(), values.size_bytes());
  return json;
}

Json SceneBuilder::positions(std::span<const Vec3> world) {
  std::vector<Vec3> local;
  for (const Vec3& p : world) local.push_back(p - offset_);
  return vectors(local);
}

Json SceneBuilder::vectors(std::span<const Vec3> values) {
  std::vector<float> flat;
  for (const Vec3& v : values)
    for (int a = 0; a < 3; ++a) flat.push_back(static_cast<float>(v[a]));
  return floats(flat, 3);
}

Json SceneBuilder::quaternions(std::span<const float> values) { return floats(values, 4); }

Json SceneBuilder::ranges(std::span<const float> values) { return floats(values, 6); }

Json SceneBuilder::scalars(std::span<const float> values) { return floats(values, 1); }

Json SceneBuilder::coarse_scalars(std::span<const float> values, double low, double high) {
  std::vector<std::uint8_t> steps;
  for (const float v : values)
    steps.push_back(static_cast<std::uint8_t>(std::lround(std::clamp((v - low) / (high - low), 0.0, 1.0) * 255.0)));
  Json json = describe(values.size(), 1, "u8");
  json["low"] = {number(low)};
  json["high"] = {number(high)};
  append(steps.data(), steps.size());
  return json;
}

Json SceneBuilder::deltas(std::span<const int> values, int components) {
  Json json = describe(values.size() / components, components, "i32");
  json["encoding"] = "delta";
  const std::vector<std::uint32_t> bits(values.begin(), values.end());
  const std::string bytes = delta_bytes<std::uint32_t>(bits, components);
  append(bytes.data(), bytes.size());
  return json;
}

Json SceneBuilder::integers(std::span<const int> values) { return deltas(values, 1); }

Json SceneBuilder::pairs(std::span<const std::array<int, 2>> values) {
  return deltas({values.empty() ? nullptr : values.front().data(), 2 * values.size()}, 2);
}

Json SceneBuilder::colors(std::span<const std::array<std::uint8_t, 3>> values) {
  Json json = describe(values.size(), 3, "u8");
  append(values.data(), values.size_bytes());
  return json;
}

Json SceneBuilder::bytes(std::string_view values) {
  Json json = describe(values.size(), 1, "u8");
  append(values.data(), values.size());
  return json;
}

Json SceneBuilder::triples(std::span<const std::array<int, 3>> values) {
  return deltas({values.empty() ? nullptr : values.front().data(), 3 * values.size()}, 3);
}

std::string SceneBuilder::encode() const {
  const std::string json = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::uint32_t length = static_cast<std::uint32_t>(json.size());
  std::string bytes = "UNS1";
  bytes.append(reinterpret_cast<const char*>(&length), 4);
  bytes += json;
  pad(bytes);
  return base64(gzip(bytes + buffer_));
}

Json quantity(std::string_view id, std::string_view name, std::string_view kind, Json array, std::string_view unit) {
  return {{"id", id}, {"name", name}, {"kind", kind}, {"unit", unit}, {"array", std::move(array)}};
}

void add_fact(SceneBuilder& scene, std::string_view name, std::string value, std::string_view help) {
  Json fact = {{"name", name}, {"value", std::move(value)}};
  if (!help.empty()) fact["help"] = help;
  scene.header["facts"].push_back(std::move(fact));
}

Json column(std::string_view name, std::string_view unit, int digits) {
  Json json = {{"name", name}, {"unit", unit}};
  if (digits >= 0) json["digits"] = digits;
  return json;
}

void add_table(SceneBuilder& scene, std::string_view title, Json columns, Json rows, std::string_view structure) {
  if (rows.empty()) return;
  Json table = {{"title", title}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
  if (!structure.empty()) table["structure"] = structure;
  scene.header["tables"].push_back(std::move(table));
}

void write_run(SceneBuilder& scene, std::string_view capability, const std::string& command, const Summary& summary, const OptionTable& options,
               const InputRecord& input) {
  Json& header = scene.header;
  header["capability"] = capability;
  header["command"] = command;
  header["version"] = kVersion;
  header["summary"] = summary_of(summary);
  header["options"] = Json::array();
  for (const Option& o : options.all()) header["options"].push_back({{"name", o.name}, {"value", o.text()}, {"unit", o.unit}, {"help", o.help}});
  header["input"] = {{"path", input.path}, {"sha256", input.sha256}};
}

void write_camera(Json& to, const RigidTransform& T_world_camera, const Camera& camera) {
  to["T_world_camera"] = Json::array();
  for (const Json& row : matrix_of(T_world_camera))
    for (const Json& value : row) to["T_world_camera"].push_back(value);
  to["fx"] = number(camera.fx);
  to["fy"] = camera.fy;
  to["cx"] = camera.cx;
  to["cy"] = camera.cy;
  to["width"] = camera.width;
  to["height"] = camera.height;
}

}  // namespace unseen::report
