// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/sniff.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "io/columns.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

bool is_binary_stl(std::string_view bytes) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  if (bytes.size() < kHeader) return false;
  const std::uint64_t count = load<std::uint32_t>(bytes.data() + 80, std::endian::native == std::endian::big);
  return count > 0 && bytes.size() - kHeader == count * kTriangle;
}

bool is_number_row(std::string_view line, std::size_t count) {
  const auto parts = words(line);
  double value = 0;
  return parts.size() == count && std::all_of(parts.begin(), parts.end(),
                                              [&](std::string_view part) { return to_number(part, value); });
}

/// Columns, rows, four rows of 3 numbers, four of 4.
bool is_ptx(std::string_view head) {
  Lines lines(head);
  std::string_view line;
  for (const std::size_t count : {1, 1, 3, 3, 3, 3, 4, 4, 4, 4})
    if (!lines.next_filled(line) || !is_number_row(line, count)) return false;
  return true;
}

Format sniff_text(std::string_view head) {
  Lines lines(head);
  std::string_view line;
  while (lines.next_filled(line)) {
    const auto fields = words(line);
    if (fields[0].front() == '#') {
      if (starts_with(trim(line), "# .PCD")) return Format::pcd;
      continue;
    }
    if (is_one_of(fields[0], {"VERSION", "FIELDS", "COLUMNS"})) return Format::pcd;
    if (is_one_of(fields[0], {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"})) return Format::off;
    if (lower(fields[0]) == "solid" && lower(head).find("facet") != std::string::npos) return Format::stl;
    if (is_one_of(fields[0], {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"}) && fields.size() > 1)
      return Format::obj;
    break;
  }
  return is_ptx(head) ? Format::ptx : Format::text;
}

/// A format that is not read, and what to make of it instead.
struct Foreign {
  const char *name = nullptr, *way_out = nullptr;
};

/// Nothing where the bytes are of none that is known here.
Foreign foreign_format(std::string_view bytes) {
  static constexpr const char *kPicture = "PNG or JPEG: save it as one of these", *kMesh = "PLY, OBJ or STL: Blender exports them", *kUnpacked = "the unpacked file",
                              *kCloud = "PLY, PCD, LAS, PTX or rows of numbers: CloudCompare and ParaView export some of them",
                              *kFile = "the file itself: a download that failed may leave a page in its place";
  struct Known {
    std::string_view start;
    Foreign format;
  };
  static const Known kKnown[] = {{{"II*\0", 4}, {"a TIFF image", kPicture}},  {{"MM\0*", 4}, {"a TIFF image", kPicture}},
                                 {"GIF8", {"a GIF image", kPicture}},         {"%PDF", {"a PDF", "PNG or JPEG: save the page as one of these"}},
                                 {"glTF", {"a glTF scene", kMesh}},           {"# vtk DataFile", {"a VTK file", kCloud}},
                                 {"AC10", {"a DWG drawing", "a PNG of the drawing, or an OBJ or STL of its solids"}},
                                 {"ISO-10303-21", {"a STEP or IFC model", "an OBJ or STL of it"}},
                                 {"Kaydara FBX", {"an FBX scene", kMesh}},    {"PK\x03\x04", {"a ZIP archive", kUnpacked}},
                                 {"\x1f\x8b", {"a gzip archive", kUnpacked}}, {"7z\xbc\xaf", {"a 7z archive", kUnpacked}},
                                 {"<!DOCTYPE html", {"a web page", kFile}},   {"<!doctype html", {"a web page", kFile}},
                                 {"<html", {"a web page", kFile}},            {"<HTML", {"a web page", kFile}},
                                 {"<", {"an XML file", kMesh}},               {"{", {"a JSON file", kMesh}}};
  for (const Known& known : kKnown)
    if (starts_with(bytes, known.start)) return known.format;
  if (starts_with(bytes, "BM") && bytes.substr(0, 64).find('\0') != std::string_view::npos) return {"a BMP image", kPicture};
  if (starts_with(bytes, "RIFF") && bytes.substr(8, 4) == "WEBP") return {"a WebP image", kPicture};
  Lines lines(bytes.substr(0, 256));
  std::string_view first, second;
  if (lines.next(first) && lines.next(second) && trim(first) == "0" && trim(second) == "SECTION") return {"a DXF drawing", "a PNG of the drawing, or an OBJ or STL of its solids"};
  return {};
}

}  // namespace

Format sniff(std::string_view bytes) {
  constexpr std::size_t kHead = 4096;
  if (starts_with(bytes, "ply\n") || starts_with(bytes, "ply\r") || starts_with(bytes, "ply "))
    return Format::ply;
  if (starts_with(bytes, "\x89PNG")) return Format::png;
  if (starts_with(bytes, "\xff\xd8\xff")) return Format::jpeg;
  if (starts_with(bytes, "LASF")) return Format::las;
  if (starts_with(bytes, "ASTM-E57")) return Format::e57;
  if (is_binary_stl(bytes)) return Format::stl;
  const std::string_view head = bytes.substr(0, kHead);
  const Format text = sniff_text(head);
  if (text == Format::text && head.find('\0') != std::string_view::npos && !starts_with(head, "\xff\xfe") &&
      !starts_with(head, "\xfe\xff"))
    return Format::unknown;
  return text;
}

Format format_of_extension(std::string_view extension) {
  static constexpr std::pair<const char*, Format> kKnown[] = {
      {"ply", Format::ply},  {"pcd", Format::pcd},  {"las", Format::las},   {"laz", Format::las},
      {"e57", Format::e57},  {"png", Format::png},  {"jpg", Format::jpeg},  {"jpeg", Format::jpeg},
      {"obj", Format::obj},  {"off", Format::off},  {"stl", Format::stl},   {"ptx", Format::ptx},
      {"xyz", Format::text}, {"csv", Format::text}, {"txt", Format::text},  {"pwn", Format::text},
      {"pts", Format::text}, {"asc", Format::text}, {"xyzn", Format::text}, {"xyzrgb", Format::text}};
  for (const auto& [known, format] : kKnown)
    if (extension == known) return format;
  return Format::unknown;
}

std::string name_of(Format format) {
  switch (format) {
    case Format::ply:
      return "a PLY file";
    case Format::pcd:
      return "a PCD file";
    case Format::las:
      return "a LAS file";
    case Format::e57:
      return "an E57 file";
    case Format::png:
      return "a PNG image";
    case Format::jpeg:
      return "a JPEG image";
    case Format::obj:
      return "an OBJ mesh";
    case Format::off:
      return "an OFF mesh";
    case Format::stl:
      return "an STL mesh";
    case Format::ptx:
      return "a PTX scan";
    case Format::text:
      return "text";
    case Format::unknown:
      break;
  }
  return "bytes of no format known here";
}

Format decide_format(std::string_view bytes, const std::string& name, std::string_view extension) {
  if (bytes.empty()) throw InputError(name, "content", "an empty file", "points");
  if (const Foreign foreign = foreign_format(bytes); foreign.name != nullptr) throw InputError(name, "content", foreign.name, foreign.way_out);
  const Format content = sniff(bytes), ending = format_of_extension(extension);
  const bool vague = content == Format::text || content == Format::unknown;
  if (ending == Format::unknown) {
    if (content != Format::unknown) return content;
    throw InputError(name, "content", name_of(content),
                     "PLY, PCD, LAS, PTX, rows of numbers, OBJ, OFF, STL, PNG or JPEG");
  }
  if (content == ending) return content;
  // A reader tells best what is wrong with a file of its own kind; scans and meshes may be called .txt.
  if (vague) return ending;
  if (ending == Format::text && (content == Format::ptx || content == Format::obj || content == Format::off))
    return content;
  throw InputError(name, "content", name_of(content) + " named ." + std::string(extension), name_of(ending));
}

}  // namespace unseen::io
