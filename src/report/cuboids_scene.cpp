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
                               : in(c.may_move)               ? "may move"
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

void add_facts(SceneBuilder& scene, const Completion& c, const OptionTable& options) {
  const auto completed = std::count_if(c.cuboids.begin(), c.cuboids.end(), [](const auto& cuboid) { return cuboid.is_completed(); });
  add_fact(scene, "stands", c.stability.stable ? "yes" : "no", "Whether forces at the contacts, within friction, can hold all boxes up");
  add_fact(scene, "boxes", std::to_string(c.cuboids.size()));
  if (!c.may_move.empty()) add_fact(scene, "boxes that may move", std::to_string(c.may_move.size()), "They stand within the tolerance of their contacts only, or fall at a slight push");
  add_fact(scene, "boxes completed", std::to_string(completed), "Boxes with a part that the picture does not show");
  add_fact(scene, "inferred volume", volume_text(c.extended_volume), "Of all parts that the picture does not show");
  add_fact(scene, "contacts", std::to_string(c.contacts.size()));
  add_fact(scene, "of them fixed", std::to_string(c.fixed_contacts), "Where touching alone would not hold, as with glue or screws: as few as possible");
  add_fact(scene, "bears a push of", fmt::format("{:.2f} g", c.stability.margin), "The least sideways acceleration that tips or shifts something");
  add_fact(scene, "friction needed", fmt::format("{:.2f} of {}", c.stability.friction_needed, options.text_of("friction")), "The least friction with which it stands, of the one that is assumed");
  add_fact(scene, "residual", fmt::format("{:.2g}", c.stability.residual), "Of the balance of forces, as a share of the weight");
  add_fact(scene, "fewest fixed contacts", c.search.optimal ? "proven" : "not proven", "Whether all other ways to complete the boxes were ruled out");
  if (c.depth_noise > 0.0) add_fact(scene, "noise of the depth", fmt::format("{:.2g} mm at 1 m", 1000.0 * c.depth_noise));
  if (!c.unsupported.empty()) add_fact(scene, "unsupported", std::to_string(c.unsupported.size()), "Boxes that nothing was found to carry");
  if (!c.held_outside.empty()) add_fact(scene, "held outside the picture", std::to_string(c.held_outside.size()));
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
  header["about"] =
      "Boxes as the depth shows them, and behind them, in a lighter dress, the part that the picture does not show. It is the least that lets everything stand: "
      "a true side may be longer. Forces are those of one way to hold everything up.";
  add_facts(scene, c, options);
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

std::string volume_text(double volume) {
  constexpr double kNothing = 1e-4;
  const double litres = 1000.0 * volume < kNothing ? 0.0 : 1000.0 * volume;
  return litres < 100.0 ? fmt::format("{:.3g} l", litres) : fmt::format("{:.0f} l", litres);
}

std::string cuboids_title(const InputRecord& input) {
  std::filesystem::path path(input.path);
  if (!path.has_filename() || path.filename() == "frame.json") path = path.parent_path();
  const std::string name = path.filename().string();
  return "Boxes of " + (name.empty() ? input.path : name);
}

}  // namespace unseen::report
