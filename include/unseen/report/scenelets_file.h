// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "unseen/interactions/scenelets.h"

namespace unseen::report {

/// A database as the bytes of its file. Little-endian: "unseenSC", u32 version, u32 length of the header, u32 length of the body once
/// unpacked, u32 CRC-32 of all that follows; the header, JSON with "recordings" (name, room, licence each), "categories" and "grid";
/// the body, packed by zlib: the recordings' poses (once, mm), their objects, and the scenelets as parts of those, with layout and saliency.
/// Poses are rounded to 1 mm, boxes to 1 µm, layouts to 1/65535, saliencies to 1/255; motion descriptors are computed anew on reading.
std::string database_bytes(const interactions::Database& database);

/// Reads such a file. Throws InputError if it is none, is cut off, damaged or of another version.
interactions::Database read_database(const std::filesystem::path& path);

/// The same from memory; `source` names it in messages.
interactions::Database parse_database(std::string_view bytes, const std::string& source);

/// The database that comes with the program: data/scenelets.bin, which `unseen scenelets build --synth 40` makes again.
const interactions::Database& shipped_database();

}  // namespace unseen::report
