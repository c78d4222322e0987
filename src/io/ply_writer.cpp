// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/ply_writer.h"

#include <fmt/format.h>

#include "io/bytes_out.h"
#include "io/file_writer.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

const char* name_of(PlyColumn::Type type) {
  switch (type) {
    case PlyColumn::Type::uint8:
      return "uchar";
    case PlyColumn::Type::int32:
      return "int";
    case PlyColumn::Type::float32:
      return "float";
    case PlyColumn::Type::float64:
      break;
  }
  return "double";
}

/// As long for every count: a comment takes up the digits that the count leaves.
std::string header(const std::vector<PlyColumn>& columns, std::size_t count) {
  constexpr std::size_t kDigits = 20;
  const std::string digits = std::to_string(count);
  std::string text =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment unseen{}\nelement vertex {}\n",
                  std::string(kDigits - digits.size(), ' '), digits);
  for (const PlyColumn& column : columns)
    text += fmt::format("property {} {}\n", name_of(column.type), column.name);
  return text + "end_header\n";
}

}  // namespace

struct PlyWriter::File {
  FileWriter writer;
  std::string buffer;
};

PlyWriter::PlyWriter(const std::filesystem::path& path, std::vector<PlyColumn> columns)
    : columns_(std::move(columns)), file_(new File{FileWriter(path), {}}) {
  file_->writer.write(header(columns_, 0));
}

PlyWriter::~PlyWriter() = default;

void PlyWriter::add(std::span<const double> row) {
  if (row.size() != columns_.size())
    throw InputError("PLY writer", "row", fmt::format("{} values", row.size()),
                     fmt::format("{}", columns_.size()));
  std::string& to = file_->buffer;
  for (std::size_t i = 0; i < row.size(); ++i) switch (columns_[i].type) {
      case PlyColumn::Type::uint8:
        append_little(to, clamped<std::uint8_t>(row[i]));
        break;
      case PlyColumn::Type::int32:
        append_little(to, clamped<std::int32_t>(row[i]));
        break;
      case PlyColumn::Type::float32:
        append_little(to, static_cast<float>(row[i]));
        break;
      case PlyColumn::Type::float64:
        append_little(to, row[i]);
        break;
    }
  ++count_;
  constexpr std::size_t kFull = std::size_t{1} << 16;
  if (to.size() < kFull) return;
  file_->writer.write(to);
  to.clear();
}

void PlyWriter::finish() {
  file_->writer.write(file_->buffer);
  file_->writer.patch(0, header(columns_, count_));
  file_->writer.close();
}

}  // namespace unseen::io
