// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/json_write.h"
#include "unseen/report/planes_result.h"

namespace unseen::report {
namespace {

Json polygon_of(const planes::Polygon& polygon) {
  return list_of(polygon, [](const auto& ring, std::size_t) {
    return list_of(ring, [](const Vec3& p, std::size_t) { return vector_of(p); });
  });
}

Json plane_of(const planes::ArrangedPlane& p, std::size_t id, bool two_dimensional) {
  Json json = {{"id", id},
               {"normal", vector_of(p.plane.normal)},
               {"offset", number(p.plane.offset)},
               {"direction", p.direction},
               {"frame", p.frame},
               {"area", number(p.area)},
               {"points", p.points},
               {"rms", number(p.rms)},
               {"turned_deg", degrees_of(p.turned)},
               {"turned_error_deg", degrees_of(p.turned_error)},
               {"tag", p.tag.empty() ? Json(nullptr) : Json(p.tag)},
               {"polygon", polygon_of(p.polygon)}};
  if (two_dimensional)
    json["segment"] =
        p.segment ? Json::array({vector_of((*p.segment)[0]), vector_of((*p.segment)[1])}) : Json(nullptr);
  return json;
}

}  // namespace

std::string planes_json(const planes::Arrangement& a, const InputRecord& input, const OptionTable& options) {
  Json json = result_header("planes", input, options, a.summary);
  json["dimensions"] = a.two_dimensional ? 2 : 3;
  json["scale"] = number(a.scale);
  json["angles_deg"] = list_of(a.angles, [](double angle, std::size_t) { return degrees_of(angle); });
  json["lambda"] = number(a.lambda);
  json["planes"] = list_of(
      a.planes, [&](const auto& plane, std::size_t id) { return plane_of(plane, id, a.two_dimensional); });
  json["directions"] = list_of(a.directions, [](const planes::Direction& d, std::size_t id) {
    return Json{{"id", id}, {"normal", vector_of(d.normal)}, {"frame", d.frame}};
  });
  json["frames"] = list_of(a.frames, [](const planes::Frame& f, std::size_t id) {
    return Json{{"id", id}, {"directions", f.directions}, {"planes", f.planes}};
  });
  json["relations"] = list_of(a.relations, [](const planes::Relation& r, std::size_t) {
    return Json{{"a", r.a}, {"b", r.b}, {"angle_deg", degrees_of(r.angle)}};
  });
  json["plane_relations"] = a.plane_relations;
  json["coplanar"] = a.coplanar;
  json["spacing"] = list_of(a.spacing, [](const planes::Spacing& s, std::size_t) {
    return Json{{"planes", s.planes}, {"step", number(s.step)}, {"rms", number(s.rms)}};
  });
  json["distances"] = list_of(a.distances, [](const planes::Distance& d, std::size_t) {
    return Json{{"a", d.a}, {"b", d.b}, {"distance", number(d.distance)}};
  });
  json["equal_lengths"] = list_of(a.equal_lengths, [](const planes::EqualLength& e, std::size_t) {
    return Json{{"planes", e.planes}, {"length", number(e.length)}, {"rms", number(e.rms)}};
  });
  return text_of(json);
}

}  // namespace unseen::report
