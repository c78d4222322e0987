// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "report/result_read.h"
#include "unseen/core/error.h"
#include "unseen/report/planes_result.h"

namespace unseen::report {
namespace {

void check_ids(const std::vector<JsonField>& items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i]["id"].count() != i) items[i]["id"].fail(fmt::format("{}, its position", i));
}

planes::ArrangedPlane read_plane(const JsonField& json, const planes::Arrangement& a) {
  planes::ArrangedPlane p;
  p.plane = {json["normal"].unit_vector(), json["offset"].number()};
  p.direction = json["direction"].index(a.directions.size());
  p.frame = json["frame"].index(a.frames.size());
  const planes::Direction& direction = a.directions[static_cast<std::size_t>(p.direction)];
  if (direction.frame != p.frame)
    json["frame"].fail(fmt::format("{}, the frame of its direction", direction.frame));
  if (!(line_angle(p.plane.normal, direction.normal) < 1e-6))
    json["normal"].fail("the normal of its direction");
  p.area = json["area"].number(0);
  p.points = json["points"].count();
  p.rms = json["rms"].number(0);
  if (json.has("turned_deg")) p.turned = radians(json["turned_deg"].number(0, 90));
  if (json.has("turned_error_deg")) p.turned_error = radians(json["turned_error_deg"].number(0, 90));
  if (!json["tag"].is_null()) p.tag = json["tag"].text();
  for (const JsonField& ring : json["polygon"].list()) {
    auto& points = p.polygon.emplace_back();
    for (const JsonField& point : ring.list()) points.push_back(point.vector());
    if (points.size() < 3) ring.fail("at least three points");
  }
  if (a.two_dimensional && !json["segment"].is_null()) {
    const auto ends = json["segment"].list();
    if (ends.size() != 2) json["segment"].fail("two points");
    p.segment = {{ends[0].vector(), ends[1].vector()}};
  }
  return p;
}

void read_frames(const JsonField& json, planes::Arrangement& a) {
  const auto directions = json["directions"].list(), frames = json["frames"].list(),
             planes = json["planes"].list();
  check_ids(directions);
  check_ids(frames);
  check_ids(planes);
  for (const JsonField& d : directions)
    a.directions.push_back({d["normal"].unit_vector(), d["frame"].index(frames.size())});
  a.frames.resize(frames.size());
  for (const JsonField& plane : planes) a.planes.push_back(read_plane(plane, a));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto belongs = [&](const auto& items, const std::string& key) {
      const std::vector<int> members = frames[f][key].indices(items.size());
      for (const int i : members)
        if (items[static_cast<std::size_t>(i)].frame != static_cast<int>(f))
          frames[f][key].fail("only what names this frame");
      return members;
    };
    a.frames[f] = {belongs(a.directions, "directions"), belongs(a.planes, "planes")};
  }
}

void read_relations(const JsonField& json, planes::Arrangement& a) {
  const std::size_t count = a.planes.size();
  for (const JsonField& r : json["relations"].list()) {
    const int first = r["a"].index(a.directions.size()), second = r["b"].index(a.directions.size());
    if (first == second) r["b"].fail("another direction than a");
    a.relations.push_back({first, second, radians(r["angle_deg"].number(0, 90))});
  }
  a.plane_relations = json["plane_relations"].count();
  for (const JsonField& group : json["coplanar"].list()) a.coplanar.push_back(group.indices(count));
  for (const JsonField& s : json["spacing"].list())
    a.spacing.push_back({s["planes"].indices(count), s["step"].number(0), s["rms"].number(0)});
  for (const JsonField& d : json["distances"].list())
    a.distances.push_back({d["a"].index(count), d["b"].index(count), d["distance"].number(0)});
  for (const JsonField& e : json["equal_lengths"].list())
    a.equal_lengths.push_back({e["planes"].indices(count), e["length"].number(0), e["rms"].number(0)});
}

}  // namespace

planes::Arrangement parse_planes_result(const std::string& text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonField json(parsed, source);
  if (json["schema"].count() != 1) json["schema"].fail("1");
  if (json["capability"].text() != "planes") json["capability"].fail("\"planes\"");
  planes::Arrangement a;
  const std::size_t dimensions = json["dimensions"].count();
  if (dimensions != 2 && dimensions != 3) json["dimensions"].fail("2 or 3");
  a.two_dimensional = dimensions == 2;
  a.scale = json["scale"].number(0);
  for (const JsonField& angle : json["angles_deg"].list()) a.angles.push_back(radians(angle.number(0, 180)));
  a.lambda = json["lambda"].number(0, 1);
  a.summary = read_summary(json["summary"], text);
  read_frames(json, a);
  read_relations(json, a);
  return a;
}

planes::Arrangement read_planes_result(const std::filesystem::path& path) {
  return parse_planes_result(read_result_text(path), path.string());
}

}  // namespace unseen::report
