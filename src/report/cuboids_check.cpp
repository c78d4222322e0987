// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/cuboids_check.h"

#include "report/json_write.h"
#include "unseen/core/version.h"

namespace unseen::report {

std::string check_json(const cuboids::Check& check, const std::vector<cuboids::Block>& blocks,
                       const cuboids::CheckOptions& options) {
  Json json = {{"unseen", kVersion},
               {"schema", 1},
               {"capability", "cuboids"},
               {"supports", options.supports},
               {"up", vector_of(options.up)},
               {"friction", number(options.friction)},
               {"stable", check.stability.stable},
               {"residual", number(check.stability.residual)},
               {"margin", number(check.stability.margin)},
               {"friction_needed", number(check.stability.friction_needed)}};
  const auto name = [&](int index) { return blocks[static_cast<std::size_t>(index)].name; };
  json["contacts"] = list_of(check.contacts, [&](const cuboids::Contact& c, std::size_t) {
    return Json{{"a", name(c.a)},
                {"b", name(c.b)},
                {"points", vectors_of(c.points)},
                {"forces", vectors_of(c.forces)},
                {"direction", vector_of(c.direction)}};
  });
  json["collapse"] = Json::array();
  for (std::size_t i = 0; i < blocks.size() && !check.stability.stable; ++i)
    if (i < check.velocity.size() && !(check.velocity[i].isZero() && check.angular_velocity[i].isZero()))
      json["collapse"].push_back({{"block", blocks[i].name},
                                  {"velocity", vector_of(check.velocity[i])},
                                  {"angular_velocity", vector_of(check.angular_velocity[i])}});
  return text_of(json);
}

}  // namespace unseen::report
