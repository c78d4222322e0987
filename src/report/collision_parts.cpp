// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/collision_parts.h"

#include <cmath>

namespace unseen::report {

using namespace collision;

Json quaternion_of(const Quat& q) { return Json::array({number(q.w()), number(q.x()), number(q.y()), number(q.z())}); }

Json state_of(const BodyState& s) {
  return {{"p", vector_of(s.p)}, {"v", vector_of(s.v)}, {"k", vector_of(s.k)}, {"q", quaternion_of(s.q)}};
}

Json impact_of(const collision::Impact& i, Json restitution, const std::array<std::string, 2>& names) {
  return {{"time", number(i.time)},
          {"frame", number(i.frame)},
          {"restitution", std::move(restitution)},
          {"tangential_restitution", or_null(i.tangential_restitution, number)},
          {"friction", or_null(i.friction, number)},
          {"impulse", vector_of(i.impulse)},
          {"contact_point", vector_of(i.contact_point)},
          {"normal", vector_of(i.normal)},
          {"between", {names.at(i.between[0]), names.at(i.between[1])}}};
}

std::optional<double> read_number_or_null(const JsonField& json) {
  if (json.is_null()) return std::nullopt;
  return json.number();
}

Quat read_unit_quaternion(const JsonField& json) {
  const auto values = json.list();
  if (values.size() != 4) json.fail("four numbers, w first");
  const Quat q(values[0].number(), values[1].number(), values[2].number(), values[3].number());
  if (!(std::abs(q.norm() - 1.0) < 1e-6)) json.fail("a quaternion of length 1");
  return q;
}

BodyState read_state(const JsonField& json) {
  return {json["p"].vector(), json["v"].vector(), json["k"].vector(), read_unit_quaternion(json["q"])};
}

}  // namespace unseen::report
