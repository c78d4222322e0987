// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace unseen::io {

Lines::Lines(std::string_view text, std::size_t at, std::size_t number)
    : text_(text), at_(at), number_(number) {
  // Old Macintosh files end lines with "\r" alone; the first line tells.
  const std::string_view head = text.substr(0, std::size_t{1} << 16);
  if (head.find('\n') == std::string_view::npos && head.find('\r') != std::string_view::npos) end_ = '\r';
}

bool Lines::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const char* start = text_.data() + at_;
  const std::size_t left = text_.size() - at_;
  const void* end = std::memchr(start, end_, left);
  const std::size_t length = end ? static_cast<std::size_t>(static_cast<const char*>(end) - start) : left;
  at_ += end ? length + 1 : length;
  ++number_;
  line = {start, length};
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

bool Lines::next_filled(std::string_view& line) {
  while (next(line))
    if (!std::all_of(line.begin(), line.end(), is_blank)) return true;
  return false;
}

std::size_t count_filled_lines(std::string_view text) {
  Lines lines(text);
  std::string_view line;
  std::size_t count = 0;
  while (lines.next_filled(line)) ++count;
  return count;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size()) return found;
    const std::size_t start = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    found.push_back(line.substr(start, at - start));
  }
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kLongest)) result += c >= 0x20 && c < 0x7f ? c : '?';
  return result + (text.size() > kLongest ? "…\"" : "\"");
}

std::string count_of(std::size_t count, const char* singular) {
  return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

bool read_number(const char*& p, const char* end, double& value) {
  const char* start = p;
  while (start != end && is_blank(*start)) ++start;
  if (start != end && *start == '+' && start + 1 != end && start[1] != '-') ++start;
  const auto [after, error] = std::from_chars(start, end, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range)
    value = std::strtod(std::string(start, after).c_str(), nullptr);
  p = after;
  return true;
}

bool to_number(std::string_view text, double& value) {
  text = trim(text);
  const char *p = text.data(), *end = text.data() + text.size();
  return !text.empty() && read_number(p, end, value) && p == end;
}

bool to_count(std::string_view text, std::size_t& value) {
  text = trim(text);
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && error == std::errc() && after == text.data() + text.size();
}

}  // namespace unseen::io
