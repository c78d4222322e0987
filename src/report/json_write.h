// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "unseen/core/geometry.h"
#include "unseen/core/options.h"
#include "unseen/core/summary.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

using Json = nlohmann::ordered_json;

/// A finite number; throws std::logic_error otherwise, for JSON has no NaN.
Json number(double value);

/// Radians as degrees; what lies within rounding of a short decimal becomes that decimal.
Json degrees_of(double radians);

Json vector_of(const Vec3& v);
Json vectors_of(const std::vector<Vec3>& vectors);

/// Columns of a rotation, a row each in the file.
Json axes_of(const Mat3& axes);

/// fx, fy, cx, cy, width, height.
Json camera_of(const Camera& camera);

/// Four rows of four numbers, the rotation times `scale`.
Json matrix_of(const RigidTransform& T, double scale = 1.0);

/// An array of what `write(item, index)` makes of each item.
template <class Items, class Write>
Json list_of(const Items& items, Write write) {
  Json list = Json::array();
  for (std::size_t i = 0; i < items.size(); ++i) list.push_back(write(items[i], i));
  return list;
}

/// What every file begins with: unseen, schema, capability, options.
Json made_by(const std::string& capability, const OptionTable& options);

/// What all results begin with: unseen, schema, capability, input, options, summary.
Json result_header(const std::string& capability, const InputRecord& input, const OptionTable& options,
                   const Summary& summary);

/// The summary as it stands in result.json.
Json summary_of(const Summary& summary);

/// As text with two blanks a level; what is not UTF-8 becomes the replacement character.
std::string text_of(const Json& json);

}  // namespace unseen::report
