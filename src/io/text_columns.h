// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_layout.h"

namespace unseen::io {

/// The first rows of a text as numbers, NaN where a part is none.
struct TextSample {
  std::vector<std::vector<double>> rows;
  std::size_t width = 0;  ///< columns

  template <class Test>
  bool all(std::size_t column, Test test) const {
    return std::all_of(rows.begin(), rows.end(), [&](const std::vector<double>& row) { return test(row[column]); });
  }
  bool whole(std::size_t column, double low, double high) const {
    return all(column, [&](double v) { return v == std::floor(v) && v >= low && v <= high; });
  }
  bool bytes_at(std::size_t column) const {
    return column + 3 <= width && whole(column, 0, 255) && whole(column + 1, 0, 255) &&
           whole(column + 2, 0, 255);
  }
  bool shares_at(std::size_t column) const {
    const auto share = [](double v) { return v >= 0.0 && v <= 1.0; };
    return all(column, share) && all(column + 1, share) && all(column + 2, share);
  }
  bool unit_at(std::size_t c) const {
    return c + 3 <= width && std::all_of(rows.begin(), rows.end(), [&](const std::vector<double>& row) {
             const double length =
                 std::sqrt(row[c] * row[c] + row[c + 1] * row[c + 1] + row[c + 2] * row[c + 2]);
             return length == 0.0 || std::abs(length - 1.0) < 0.01;
           });
  }
};

/// What names speak of; surveyors' letters count where nothing else names the axes.
std::vector<Role> roles_of_names(const std::vector<std::string>& names);

/// Gives the columns of a layout the roles that their names speak of.
void roles_from_names(const TextSample& sample, const std::vector<std::string>& names, const std::string& label_field, TextLayout& layout);

/// Gives the columns of a layout the roles that their values look like; `extension` is the file's.
void roles_from_values(const TextSample& sample, std::string_view extension, TextLayout& layout);

}  // namespace unseen::io
