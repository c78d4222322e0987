// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/cuboids_truth.h"

#include <cmath>

#include "report/json_write.h"

namespace unseen::report {
std::string cuboids_truth_json(const cuboids::SynthView& view, const OptionTable& options) {
  const cuboids::Truth& truth = view.truth;
  Json json = made_by("synth cuboids", options);
  json["family"] = truth.family;
  json["stands"] = truth.stands;
  json["view"] = view.number;
  json["azimuth_deg"] = degrees_of(view.azimuth);
  json["T_world_camera"] = matrix_of(truth.T_world_camera);
  json["supports"] = Json::array();
  for (const cuboids::Support& support : truth.supports)
    json["supports"].push_back({{"id", support.id},
                                {"kind", cuboids::kSupportKinds[static_cast<int>(support.kind)]},
                                {"normal", vector_of(support.plane.normal)},
                                {"offset", number(support.plane.offset)}});
  json["cuboids"] = Json::array();
  for (const cuboids::TrueCuboid& cuboid : truth.cuboids) {
    Json axes = Json::array(), hidden = Json::array();
    for (int k = 0; k < 3; ++k) axes.push_back(vector_of(cuboid.box->axes.col(k)));
    for (const double share : cuboid.hidden) hidden.push_back(number(share));
    json["cuboids"].push_back({{"id", cuboid.id},
                               {"center", vector_of(cuboid.box->center)},
                               {"axes", axes},
                               {"size", vector_of(cuboid.size)},
                               {"density", number(cuboid.density)},
                               {"hidden", hidden},
                               {"seen", vector_of(cuboid.seen)}});
  }
  json["contacts"] = Json::array();
  for (const cuboids::Contact& contact : truth.contacts)
    json["contacts"].push_back({{"a", contact.a},
                                {"b", contact.b},
                                {"kind", cuboids::kContactKinds[static_cast<int>(contact.kind)]}});
  return text_of(json);
}

std::string synth_frame_json(const cuboids::SynthView& view, bool with_masks) {
  Json json = {{"depth", "depth.png"},
               {"depth_scale", kSynthDepthScale},
               {"color", "color.png"},
               {"camera",
                {{"fx", view.camera.fx}, {"fy", view.camera.fy}, {"cx", view.camera.cx}, {"cy", view.camera.cy}}}};
  if (with_masks) json["masks"] = "masks.png";
  return text_of(json);
}

std::vector<std::uint16_t> synth_depth_pixels(const cuboids::SynthView& view) {
  std::vector<std::uint16_t> pixels;
  pixels.reserve(view.depth.size());
  for (const float depth : view.depth) {
    const double units = std::round(static_cast<double>(depth) * kSynthDepthScale);
    pixels.push_back(units > 65535.0 ? 0 : static_cast<std::uint16_t>(units));
  }
  return pixels;
}

}  // namespace unseen::report
