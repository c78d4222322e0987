// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/json_write.h"
#include "unseen/report/cuboids_result.h"

namespace unseen::report {
namespace {

Json support_of(const cuboids::Support& s) {
  Json json = {{"id", s.id},
               {"kind", cuboids::kSupportKinds[static_cast<int>(s.kind)]},
               {"normal", vector_of(s.plane.normal)},
               {"offset", number(s.plane.offset)}};
  if (!s.outline.empty()) json["outline"] = vectors_of(s.outline);
  return json;
}

Json cuboid_of(const cuboids::Cuboid& c) {
  Json json = {{"id", c.id},
               {"center", vector_of(c.box.center)},
               {"axes", axes_of(c.box.axes)},
               {"size", vector_of(2.0 * c.box.half_size)},
               {"initial_center", vector_of(c.initial.center)},
               {"initial_axes", axes_of(c.initial.axes)},
               {"initial_size", vector_of(2.0 * c.initial.half_size)},
               {"visible_points", c.visible_points},
               {"density", number(c.density)},
               {"mass", number(c.mass())}};
  if (!c.label.empty()) json["label"] = c.label;
  if (c.by_symmetry) json["by_symmetry"] = true;
  return json;
}

Json contact_of(const cuboids::Contact& c) {
  return {{"a", c.a},
          {"b", c.b},
          {"kind", cuboids::kContactKinds[static_cast<int>(c.kind)]},
          {"points", vectors_of(c.points)},
          {"forces", vectors_of(c.forces)},
          {"direction", vector_of(c.direction)}};
}

}  // namespace

std::string cuboids_json(const cuboids::Completion& c, const InputRecord& input, const OptionTable& options) {
  Json json = result_header("cuboids", input, options, c.summary);
  json["T_world_camera"] = matrix_of(c.T_world_camera);
  json["depth_noise"] = number(c.depth_noise);
  json["supports"] = list_of(c.supports, [](const auto& s, std::size_t) { return support_of(s); });
  json["cuboids"] = list_of(c.cuboids, [](const auto& cuboid, std::size_t) { return cuboid_of(cuboid); });
  json["contacts"] = list_of(c.contacts, [](const auto& contact, std::size_t) { return contact_of(contact); });
  json["stability"] = {{"residual", number(c.stability.residual)},
                       {"stable", c.stability.stable},
                       {"margin", number(c.stability.margin)},
                       {"friction_needed", number(c.stability.friction_needed)}};
  json["fixed_contacts"] = c.fixed_contacts;
  json["extended_volume"] = number(c.extended_volume);
  json["unsupported"] = c.unsupported;
  json["held_outside"] = c.held_outside;
  json["may_move"] = c.may_move;
  json["search"] = {{"nodes", c.search.nodes}, {"pruned", c.search.pruned}, {"optimal", c.search.optimal}};
  return text_of(json);
}

}  // namespace unseen::report
