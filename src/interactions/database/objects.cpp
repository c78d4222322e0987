// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

int category_index(const std::string& category) {
  const auto found = std::find(kCategories.begin(), kCategories.end(), category);
  return static_cast<int>(std::min<std::ptrdiff_t>(found - kCategories.begin(), kCategories.size() - 1));
}

Superclass superclass_of(const std::string& category) {
  switch (category_index(category)) {
    case 0: case 1: case 2: case 3: return Superclass::sit;
    case 4: case 5: return Superclass::table;
    case 6: return Superclass::shelf;
    default: return Superclass::other;
  }
}

bool is_main(const Part& part) {
  const std::string name = part.name.substr(0, part.name.find('-'));
  return name == "seat" || name == "top" || name == "shelf";
}

Vec3 Object::center() const {
  Vec3 main = Vec3::Zero(), all = Vec3::Zero();
  int count = 0;
  for (const Part& part : parts) {
    all += part.box.center;
    if (!is_main(part)) continue;
    main += part.box.center;
    ++count;
  }
  if (count > 0) return main / count;
  return parts.empty() ? all : Vec3(all / static_cast<double>(parts.size()));
}

Object operator*(const Placement& placement, const Object& object) {
  Object placed = object;
  for (Part& part : placed.parts) part.box = placement * part.box;
  return placed;
}

}  // namespace unseen::interactions
