// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "report/json_write.h"
#include "report/result_read.h"
#include "unseen/collision/types.h"

// What results and truth of `collision` have in common.
namespace unseen::report {

/// The names of the two bodies in "frames".
inline constexpr const char* kBodyKeys[] = {"a", "b"};

template <class T, class Write>
Json or_null(const std::optional<T>& value, Write write) {
  return value ? Json(write(*value)) : Json(nullptr);
}

/// [w, x, y, z].
Json quaternion_of(const collision::Quat& q);
Json state_of(const collision::BodyState& s);
/// An impact between two of the `names`, with its restitution as given.
Json impact_of(const collision::Impact& i, Json restitution, const std::array<std::string, 2>& names);

std::optional<double> read_number_or_null(const JsonField& json);
/// Of length 1 within 1e-6.
collision::Quat read_unit_quaternion(const JsonField& json);
collision::BodyState read_state(const JsonField& json);

}  // namespace unseen::report
