// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <string_view>

namespace unseen::io {

enum class Format { ply, pcd, las, e57, png, jpeg, obj, off, stl, ptx, text, unknown };

/// What the bytes are, whatever the file is called. `text` is any other text; `unknown` other bytes.
Format sniff(std::string_view bytes);
/// What an ending (lower case, without the dot) stands for; `unknown` if nothing here.
Format format_of_extension(std::string_view extension);
/// "a PNG image", …
std::string name_of(Format format);
/// The format to read a file as. Throws InputError if it is empty, unknown, or named as what it is not.
Format decide_format(std::string_view bytes, const std::string& name, std::string_view extension);

}  // namespace unseen::io
