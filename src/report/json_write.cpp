// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/json_write.h"

#include <cmath>
#include <stdexcept>

#include "core/overload.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

Json value_of(const Option& option) {
  return std::visit(
      Overload{[](const bool* b) { return Json(*b); }, [](const int* i) { return Json(*i); },
               [](const double* d) { return number(*d); }, [](const std::string* s) { return Json(*s); },
               [](const std::optional<double>* d) { return *d ? number(**d) : Json(nullptr); },
               [](const std::vector<double>* v) {
                 Json list = Json::array();
                 for (const double d : *v) list.push_back(number(d));
                 return list;
               }},
      option.target);
}

}  // namespace

Json number(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a result holds a number that is not finite");
  return value == 0.0 ? 0.0 : value;  // no "-0.0"
}

Json degrees_of(double radians) {
  const double exact = degrees(radians), rounded = std::round(exact * 1e6) / 1e6;
  return number(std::abs(exact - rounded) < 1e-12 ? rounded : exact);
}

Json vectors_of(const std::vector<Vec3>& vectors) {
  return list_of(vectors, [](const Vec3& v, std::size_t) { return vector_of(v); });
}

Json vector_of(const Vec3& v) {
  return Json::array({number(v.x()), number(v.y()), number(v.z())});
}

Json axes_of(const Mat3& axes) {
  return Json::array({vector_of(axes.col(0)), vector_of(axes.col(1)), vector_of(axes.col(2))});
}

Json camera_of(const Camera& c) {
  return {{"fx", number(c.fx)}, {"fy", number(c.fy)}, {"cx", number(c.cx)}, {"cy", number(c.cy)}, {"width", c.width}, {"height", c.height}};
}

Json matrix_of(const RigidTransform& T, double scale) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 3; ++c) row.push_back(number(scale * T.rotation(r, c)));
    row.push_back(number(T.translation[r]));
    rows.push_back(row);
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

Json summary_of(const Summary& summary) {
  Json seconds = Json::object(), energy = Json::object(), counts = Json::object();
  for (const auto& [name, value] : summary.seconds) seconds[name] = number(value);
  for (const auto& [name, value] : summary.energy) energy[name] = number(value);
  for (const auto& [name, value] : summary.counts) counts[name] = value;
  return {{"status", to_string(summary.status)},
          {"seconds", seconds},
          {"energy", energy},
          {"counts", counts},
          {"warnings", summary.warnings}};
}

Json made_by(const std::string& capability, const OptionTable& options) {
  Json values = Json::object();
  for (const Option& option : options.all()) values[option.name] = value_of(option);
  return {{"unseen", kVersion}, {"schema", 1}, {"capability", capability}, {"options", values}};
}

Json result_header(const std::string& capability, const InputRecord& input, const OptionTable& options,
                   const Summary& summary) {
  Json json = made_by(capability, options);
  json["input"] = {{"path", input.path},
                   {"sha256", input.sha256.empty() ? Json(nullptr) : Json(input.sha256)}};
  json["summary"] = summary_of(summary);
  return json;
}

std::size_t count_of(const Summary& summary, std::string_view name) {
  for (const auto& [key, value] : summary.counts)
    if (key == name) return value;
  return 0;
}

std::string summary_json(const Summary& summary) {
  return text_of(summary_of(summary));
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace unseen::report
