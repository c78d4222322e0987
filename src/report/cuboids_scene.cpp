// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/cuboids_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "report/cuboids_structures.h"

namespace unseen::report {
namespace {

using cuboids::Completion;

constexpr std::size_t kPointsShown = 400'000;

/// "41.2 × 26.3 × 15.0"
std::string sizes(const OrientedBox& box) {
  const Vec3 s = 200.0 * box.half_size;  // cm
  return fmt::format("{:.1f} × {:.1f} × {:.1f}", s.x(), s.y(), s.z());
}

void add_box_table(SceneBuilder& scene, const Completion& c) {
  Json rows = Json::array();
  for (const cuboids::Cuboid& cuboid : c.cuboids) {
    const auto in = [&](const std::vector<int>& ids) { return std::find(ids.begin(), ids.end(), cuboid.id) != ids.end(); };
    const std::string remark = in(c.unsupported)              ? "unsupported"
                               : in(c.held_outside)           ? "held outside"
                               : cuboid.by_symmetry           ? "by symmetry"
                               : cuboid.is_completed()        ? "completed"
                                                              : "";
    rows.push_back({name_of(cuboid), sizes(cuboid.box), cuboid.by_symmetry ? "–" : sizes(cuboid.initial), remark,
                    number(cuboid.mass()), cuboid.visible_points});
  }
  scene.header["tables"].push_back({{"title", "Boxes"},
                                    {"structure", "boxes"},
                                    {"columns",
                                     {column("box"), column("size", "cm"), column("as fitted", "cm"), column("remark"),
                                      column("mass", "kg", 2), column("points")}},
                                    {"rows", std::move(rows)}});
}

void add_support_table(SceneBuilder& scene, const Completion& c) {
  Json rows = Json::array();
  for (const cuboids::Support& s : c.supports) {
    const Vec3& n = s.plane.normal;
    rows.push_back({name_of(s), fmt::format("{:.3f}, {:.3f}, {:.3f}", n.x(), n.y(), n.z()), number(s.plane.offset)});
  }
  scene.header["tables"].push_back({{"title", "Supports"},
                                    {"structure", "supports"},
                                    {"columns", {column("support"), column("normal"), column("offset", "m", 3)}},
                                    {"rows", std::move(rows)}});
}

void add_contact_table(SceneBuilder& scene, const Completion& c) {
  std::vector<std::string> names;
  for (const cuboids::Support& s : c.supports) names.push_back(name_of(s));
  for (const cuboids::Cuboid& cuboid : c.cuboids) names.push_back(name_of(cuboid));
  Json rows = Json::array();
  const std::vector<CarriedContact> carried = carried_contacts(c);
  for (std::size_t k = 0; k < carried.size(); ++k) {
    const bool known = !c.contacts[k].forces.empty();
    rows.push_back({names[carried[k].from], names[carried[k].to],
                    cuboids::kContactKinds[static_cast<int>(c.contacts[k].kind)],
                    known ? number(carried[k].force.norm()) : Json(nullptr), c.contacts[k].points.size()});
  }
  scene.header["tables"].push_back(
      {{"title", "Contacts"},
       {"columns", {column("carries"), column("carried"), column("kind"), column("force", "N", 2), column("points")}},
       {"rows", std::move(rows)}});
}

Json facts_of(const Completion& c, const OptionTable& options) {
  Json facts = Json::array();
  const auto fact = [&](std::string_view name, std::string value) {
    facts.push_back({{"name", name}, {"value", std::move(value)}});
  };
  const auto completed = std::count_if(c.cuboids.begin(), c.cuboids.end(), [](const auto& cuboid) { return cuboid.is_completed(); });
  fact("stands", c.stability.stable ? "yes" : "no");
  fact("boxes", std::to_string(c.cuboids.size()));
  fact("boxes completed", std::to_string(completed));
  fact("inferred volume", fmt::format("{:.3g} l", 1000.0 * c.extended_volume));
  fact("contacts", std::to_string(c.contacts.size()));
  fact("of them fixed", std::to_string(c.fixed_contacts));
  fact("bears a push of", fmt::format("{:.2f} g", c.stability.margin));
  fact("friction needed", fmt::format("{:.2f} of {}", c.stability.friction_needed, options.text_of("friction")));
  fact("residual", fmt::format("{:.2g}", c.stability.residual));
  fact("fewest fixed contacts", c.search.optimal ? "proven" : "not proven");
  if (c.depth_noise > 0.0) fact("noise of the depth", fmt::format("{:.2g} mm at 1 m", 1000.0 * c.depth_noise));
  if (!c.unsupported.empty()) fact("unsupported", std::to_string(c.unsupported.size()));
  if (!c.held_outside.empty()) fact("held outside the picture", std::to_string(c.held_outside.size()));
  return facts;
}

/// The boxes and what they stand on nearby, not the room behind.
Json focus_of(const Completion& c) {
  Eigen::AlignedBox3d reach;
  for (const cuboids::Cuboid& cuboid : c.cuboids)
    for (const Vec3& corner : corners_of(cuboid.box)) reach.extend(corner);
  const Vec3 margin = Vec3::Constant(0.1 * reach.sizes().maxCoeff());
  return {{"low", vector_of(reach.min() - margin)}, {"high", vector_of(reach.max() + margin)}};
}

}  // namespace

std::string cuboids_scene(const Completion& c, const InputRecord& input, const OptionTable& options,
                          const std::string& command, const RgbdFrame& frame) {
  SceneBuilder scene(Vec3::Zero());
  Json& header = scene.header;
  header["title"] = cuboids_title(input);
  write_run(scene, "cuboids", command, c.summary, options, input);
  if (c.cuboids.empty()) header["verdict"] = "no box was found";
  header["inside"] = false;
  if (!c.cuboids.empty()) header["focus"] = focus_of(c);
  header["facts"] = facts_of(c, options);
  const DepthPoints points = depth_points(frame, c.T_world_camera, kPointsShown);
  if (points.positions.size() < points.seen)
    header["thinned"] = {{"shown", points.positions.size()}, {"of", points.seen}};
  add_boxes(scene, c);
  add_contact_graph(scene, c);
  add_supports(scene, c);
  add_depth(scene, c, points);
  add_camera(scene, c, frame);
  add_box_table(scene, c);
  add_contact_table(scene, c);
  add_support_table(scene, c);
  return scene.encode();
}

std::string cuboids_title(const InputRecord& input) {
  std::filesystem::path path(input.path);
  if (!path.has_filename() || path.filename() == "frame.json") path = path.parent_path();
  const std::string name = path.filename().string();
  return "Boxes of " + (name.empty() ? input.path : name);
}

}  // namespace unseen::report
