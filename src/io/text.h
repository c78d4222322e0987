// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace unseen::io {

/// The lines of a text, one after another; "\n" and "\r\n" end a line, in files without any "\n" also "\r".
class Lines {
 public:
  Lines() = default;
  explicit Lines(std::string_view text, std::size_t at = 0, std::size_t number = 0);

  /// The next line without its end; false after the last.
  bool next(std::string_view& line);
  /// The next line that is not blank.
  bool next_filled(std::string_view& line);
  std::size_t offset() const { return at_; }      ///< where the next line starts
  std::size_t number() const { return number_; }  ///< of the line last given, from 1

 private:
  std::string_view text_;
  std::size_t at_ = 0, number_ = 0;
  char end_ = '\n';
};

/// How many lines of `text` are not blank.
std::size_t count_filled_lines(std::string_view text);

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}
std::string_view trim(std::string_view text);
/// Words separated by blanks.
std::vector<std::string_view> words(std::string_view line);
std::string lower(std::string_view text);
/// "text" in quotes, cut to a length that suits a message.
std::string shown(std::string_view text);
/// "1 point", "3 points".
std::string count_of(std::size_t count, const char* singular);

/// Reads a number at the start of [p, end) after blanks and moves p behind it; false (p unchanged) if none is
/// there. Takes a leading +, nan and inf; what a double cannot hold becomes 0 or infinite.
bool read_number(const char*& p, const char* end, double& value);
/// The whole of `text` as a number.
bool to_number(std::string_view text, double& value);
/// The whole of `text` as a whole number that is not negative.
bool to_count(std::string_view text, std::size_t& value);

}  // namespace unseen::io
