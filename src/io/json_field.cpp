// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/json_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <unordered_set>

#include "core/shortened.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr std::size_t kLongest = 60;  // characters of what was found that a message holds

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& source, const std::string& expected) {
  constexpr int kDeepest = 64;
  using Event = nlohmann::json::parse_event_t;
  struct Open {
    std::unordered_set<std::string> keys;
    std::string last;
  };
  std::vector<Open> objects;  // from the outermost one
  const auto path = [&] {
    std::vector<std::string> names;
    for (const Open& object : objects) names.push_back(shortened(object.last, kLongest));
    return fmt::format("{}", fmt::join(names, "."));
  };
  if (text.find('\0') != std::string::npos) throw InputError(source, "", "no text in UTF-8, but bytes as of a video, a picture or a binary cloud", expected);
  const auto check = [&](int depth, Event event, const nlohmann::json& parsed) {
    if (depth > kDeepest && (event == Event::object_start || event == Event::array_start))
      throw InputError(source, "", fmt::format("more than {} nested levels", kDeepest), expected);
    if (event == Event::object_start) objects.emplace_back();
    if (event == Event::object_end) objects.pop_back();
    if (event == Event::key) {
      objects.back().last = parsed.get_ref<const std::string&>();
      if (!objects.back().keys.insert(objects.back().last).second) throw InputError(source, path(), "twice in one object", "once");
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text, check);
  } catch (const nlohmann::json::exception& e) {
    const std::string what = e.what(), reason = what.substr(what.find("] ") == std::string::npos ? 0 : what.find("] ") + 2);  // without the library's number
    const bool complete = dynamic_cast<const nlohmann::json::out_of_range*>(&e);  // a number that is too large; else nobody knows where the mistake is
    throw InputError(source, complete ? path() : "", "broken JSON (" + reason + ")", expected);
  }
}

std::string read_text_file(const std::filesystem::path& path, std::size_t largest) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path.string(), "", "a folder", "a file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw InputError(path.string(), "", error.message(), "a file that can be read");
  if (size > largest)
    throw InputError(path.string(), "", fmt::format("{} bytes", size), fmt::format("at most {} MiB", largest >> 20));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "", "no permission", "a file that can be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

JsonField JsonField::operator[](const std::string& key) const {
  if (!value_->is_object()) fail("an object");
  const auto at = value_->find(key);
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (at == value_->end()) throw InputError(source_, path, "nothing", "this field");
  return {*at, source_, path};
}

bool JsonField::has(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

std::size_t JsonField::size() const {
  if (!value_->is_array()) fail("an array");
  return value_->size();
}

std::vector<JsonField> JsonField::list(std::size_t most) const {
  if (size() > most) fail(fmt::format("at most {} entries", most));  // before a huge one is taken apart
  std::vector<JsonField> fields;
  for (std::size_t i = 0; i < value_->size(); ++i)
    fields.emplace_back((*value_)[i], source_, fmt::format("{}[{}]", path_, i));
  return fields;
}

std::vector<std::pair<std::string, JsonField>> JsonField::members() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::pair<std::string, JsonField>> fields;
  for (const auto& [key, value] : value_->items())
    fields.emplace_back(key, JsonField(value, source_, path_.empty() ? key : path_ + "." + key));
  return fields;
}

std::string JsonField::text() const {
  if (!value_->is_string()) fail("text");
  return value_->get<std::string>();
}

double JsonField::number(double min, double max) const {
  if (!value_->is_number()) fail("a number");
  const double v = value_->get<double>();
  if (!std::isfinite(v) || v < min || v > max) fail(fmt::format("a number in [{}, {}]", min, max));
  return v;
}

bool JsonField::truth() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

std::size_t JsonField::count() const {
  if (!value_->is_number_unsigned()) fail("a whole number, at least 0");
  return value_->get<std::size_t>();
}

int JsonField::index(std::size_t size) const {
  if (!value_->is_number_unsigned() || value_->get<std::size_t>() >= size)
    fail(fmt::format("an index below {}", size));
  return static_cast<int>(value_->get<std::size_t>());
}

std::vector<int> JsonField::indices(std::size_t size) const {
  std::vector<int> values;
  for (const JsonField& field : list()) values.push_back(field.index(size));
  return values;
}

Vec3 JsonField::vector() const {
  if (value_->is_array() && value_->size() != 3) fail("three numbers");  // before a huge one is taken apart
  const auto fields = list();
  return {fields[0].number(), fields[1].number(), fields[2].number()};
}

Vec3 JsonField::unit_vector() const {
  const Vec3 v = vector();
  if (!(std::abs(v.norm() - 1.0) < 1e-6)) fail("a vector of length 1");
  return v;
}

void JsonField::allow_only(const std::vector<std::string>& known) const {
  for (const auto& [key, member] : members())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw InputError(source_, member.path_, "an unknown field", fmt::format("{}", fmt::join(known, ", ")));
}

std::optional<OptionInput> JsonField::option() const {
  if (value_->is_null()) return std::nullopt;
  if (value_->is_boolean()) return value_->get<bool>();
  if (value_->is_string()) return text();
  if (!value_->is_array()) return number();
  std::vector<double> numbers;
  for (const JsonField& n : list()) numbers.push_back(n.number());
  return numbers;
}

void JsonField::fail(const std::string& expected) const {
  constexpr std::size_t kFew = 4;
  std::string found;
  if (value_->is_array() && (value_->size() > kFew || std::any_of(value_->begin(), value_->end(), [](const auto& entry) { return !entry.is_primitive(); }))) {
    found = fmt::format("an array of {}", value_->size());
  } else if (value_->is_object()) {
    found = "an object";
  } else {
    found = shortened(value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), kLongest);
  }
  throw InputError(source_, path_, found, expected);
}

std::filesystem::path named_file(const JsonField& json, const std::string& key, const std::filesystem::path& folder) {
  if (!json.has(key)) return {};
  const std::string name = json[key].text();
  if (name.empty() || name.find('\0') != std::string::npos) json[key].fail("the name of a file");
  std::error_code error;
  const std::filesystem::path path = folder / name;
  if (!std::filesystem::exists(path, error)) json[key].fail(folder.empty() ? "a file beside this one" : fmt::format("a file in {}", folder.string()));
  return path;
}

}  // namespace unseen::io
