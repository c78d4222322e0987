// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"
#include "io/readers.h"

namespace unseen::io {

/// How the rows of a text file are to be read.
struct TextLayout {
  char separator = ' ';        ///< besides blanks
  bool decimal_comma = false;  ///< "1,5" is one and a half
  std::vector<Column> columns;
  std::size_t data = 0, data_line = 0;  ///< where the rows start, lines before them
  std::optional<std::size_t> promised;  ///< points by the leading count
  bool normals_follow = false;          ///< PWN: as many rows of normals after the points
  bool two_dimensional = false;
  std::vector<std::string> notes;  ///< what was guessed
};

/// Guesses separator and columns from the start of the file. Throws InputError if there are no rows of
/// numbers.
TextLayout guess_text_layout(const Input& input);

/// A line that holds a remark: it starts with #, % or //.
bool is_remark(std::string_view line);
/// The parts of a row; blanks separate too, except that every separator other than a blank ends a part.
std::vector<std::string_view> split_row(std::string_view line, char separator);
/// A part as a number; empty parts are NaN, quotes are taken off.
bool row_number(std::string_view part, bool decimal_comma, double& value);

}  // namespace unseen::io
