// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "io/rgbd_parts.h"
#include "report/result_read.h"
#include "unseen/core/error.h"
#include "unseen/io/rgbd.h"
#include "unseen/report/cuboids_truth.h"

namespace unseen::report {
namespace {

constexpr std::size_t kMostLabels = 1'000'000'000;
constexpr double kMillimetre = 1e-3;
constexpr int kFirstObject = 20;  // labels below mark the support

cuboids::TrueCuboid true_cuboid(const JsonField& json, std::set<int>& ids) {
  cuboids::TrueCuboid c;
  c.id = new_id(json["id"], ids);
  c.size = json["size"].vector();
  if (!(c.size.minCoeff() > 0)) json["size"].fail("three sizes above 0");
  OrientedBox box;
  box.center = json["center"].vector();
  box.half_size = c.size / 2;
  const auto axes = json["axes"].list();
  if (axes.size() != 3) json["axes"].fail("three axes");
  for (int k = 0; k < 3; ++k) box.axes.col(k) = axes[static_cast<std::size_t>(k)].unit_vector();
  if (!RigidTransform{box.axes, Vec3::Zero()}.is_rigid(1e-6)) json["axes"].fail("three right-handed axes");
  c.box = box;
  c.density = json["density"].number(0);
  const auto hidden = json["hidden"].list();
  if (hidden.size() != c.hidden.size()) json["hidden"].fail("six shares");
  for (std::size_t f = 0; f < hidden.size(); ++f) c.hidden[f] = hidden[f].number(0, 1);
  c.seen = json["seen"].vector();
  return c;
}

int label_of(const std::string& text, const JsonField& json) {
  int label = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
  if (error != std::errc() || end != text.data() + text.size() || label < kFirstObject)
    json.fail("objects named by labels from 20 on");
  return label;
}

}  // namespace

cuboids::Truth read_cuboids_truth(const std::filesystem::path& path) {
  const nlohmann::json parsed = parse_json(read_result_text(path), path.string());
  const JsonField json(parsed, path.string());
  if (json["capability"].text() != "synth cuboids") json["capability"].fail("\"synth cuboids\"");
  cuboids::Truth truth;
  truth.family = json["family"].text();
  truth.stands = json["stands"].truth();
  truth.T_world_camera = read_transform(json["T_world_camera"]);
  std::set<int> ids;
  for (const JsonField& field : json["supports"].list()) {
    cuboids::Support support;
    support.id = new_id(field["id"], ids);
    support.kind = kind_of<cuboids::SupportKind>(field["kind"], cuboids::kSupportKinds);
    support.plane = {field["normal"].unit_vector(), field["offset"].number()};
    truth.supports.push_back(support);
  }
  for (const JsonField& field : json["cuboids"].list()) truth.cuboids.push_back(true_cuboid(field, ids));
  for (const JsonField& field : json["contacts"].list()) {
    cuboids::Contact contact;
    contact.a = known_id(field["a"], ids);
    contact.b = known_id(field["b"], ids);
    contact.kind = kind_of<cuboids::ContactKind>(field["kind"], cuboids::kContactKinds);
    truth.contacts.push_back(contact);
  }
  return truth;
}

std::vector<HiddenDimension> parse_hidden_dimensions(const std::string& text, const std::string& source) {
  std::vector<HiddenDimension> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size()), colon = text.find(':', at);
    const std::string item = text.substr(at, end - at);
    double millimetres = 0;
    const char* last = text.data() + end;
    const bool named = colon != std::string::npos && colon > at && colon < end;
    if (!named || std::from_chars(text.data() + colon + 1, last, millimetres).ptr != last || !(millimetres > 0))
      throw InputError(source, "hidden", item, "NAME:MILLIMETRES,…");
    all.push_back({text.substr(at, colon - at), millimetres * kMillimetre});
    at = end + 1;
  }
  return all;
}

cuboids::Truth read_measured_truth(const std::filesystem::path& path, const std::filesystem::path& frame_folder,
                                   const std::vector<HiddenDimension>& hidden) {
  const nlohmann::json parsed = parse_json(read_result_text(path), path.string());
  const JsonField json(parsed, path.string());
  const std::filesystem::path folder = std::filesystem::absolute(frame_folder).lexically_normal();
  cuboids::Truth truth;
  truth.family = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  const JsonField frame = json["frames"][truth.family];
  const RgbdFrame picture = io::read_rgbd_frame(frame_folder);
  const std::vector<std::int32_t> labels = io::read_masks(frame_folder / "label.png", picture.camera);

  truth.supports.push_back({0, cuboids::SupportKind::ground, {}, {}});
  std::map<int, int> id_of_object;  // tens digit of the labels
  for (const auto& [label, name] : frame["obj"].members()) {
    cuboids::TrueCuboid cuboid;
    cuboid.id = static_cast<int>(truth.cuboids.size()) + 1;
    cuboid.name = name.text();
    cuboid.size = kMillimetre * json["dims_mm"][cuboid.name].vector();
    std::sort(cuboid.size.data(), cuboid.size.data() + 3, std::greater<>());
    for (const HiddenDimension& dimension : hidden)
      for (int k = 0; k < 3; ++k)
        if (dimension.name == cuboid.name && std::abs(dimension.size - cuboid.size[k]) < 0.5 * kMillimetre)
          cuboid.seen[k] = 0.0;
    const int object = label_of(label, name) / 10;
    id_of_object[object] = cuboid.id;
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (labels[i] / 10 == object && picture.depth[i] > 0) {
        const int u = static_cast<int>(i) % picture.camera.width, v = static_cast<int>(i) / picture.camera.width;
        cuboid.points.push_back(picture.camera.unproject(u, v, static_cast<double>(picture.depth[i])));
      }
    truth.cuboids.push_back(cuboid);
  }
  const auto id_of = [&](const JsonField& field) {
    const int label = field.index(kMostLabels);
    if (label < kFirstObject) return 0;
    if (id_of_object.count(label / 10) == 0) field.fail("a label of \"obj\", or of the support");
    return id_of_object.at(label / 10);
  };
  for (const JsonField& edge : frame["edges"].list()) {
    const auto ends = edge.list();
    if (ends.size() != 2) edge.fail("two labels");
    cuboids::Contact contact;
    contact.a = id_of(ends[0]);
    contact.b = id_of(ends[1]);
    truth.contacts.push_back(contact);
  }
  return truth;
}

}  // namespace unseen::report
