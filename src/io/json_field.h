// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/options.h"

namespace unseen::io {

/// Parses JSON of at most 64 levels, of whose objects no key is there twice. Throws InputError; `expected` says what the text should have been.
nlohmann::json parse_json(const std::string& text, const std::string& source,
                          const std::string& expected = "a result of unseen");

/// The whole of a text file of at most `largest` bytes. Throws InputError.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest);

class JsonField;

/// The file that the member `key` names, relative to `folder`; empty if there is no such member. Throws InputError if it does not exist.
std::filesystem::path named_file(const JsonField& json, const std::string& key, const std::filesystem::path& folder);

/// A value within a JSON file that knows where it stands, "planes[3].normal", so that every failed check
/// throws an InputError which names file and field. Refers to the parsed file, which must outlive it.
class JsonField {
 public:
  JsonField(const nlohmann::json& value, std::string source, std::string path = "")
      : value_(&value), source_(std::move(source)), path_(std::move(path)) {}

  /// A member that must exist.
  JsonField operator[](const std::string& key) const;
  bool has(const std::string& key) const;
  bool is_null() const { return value_->is_null(); }
  bool is_array() const { return value_->is_array(); }
  bool is_object() const { return value_->is_object(); }
  bool is_number() const { return value_->is_number(); }
  bool is_text() const { return value_->is_string(); }
  /// The number of entries of an array.
  std::size_t size() const;
  /// The entries of an array of at most `most`.
  std::vector<JsonField> list(std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// The members of an object, in the file's order of names.
  std::vector<std::pair<std::string, JsonField>> members() const;

  static constexpr double kLargest = 1e100;  ///< products of what is larger may not be finite
  std::string text() const;
  double number(double min = -kLargest, double max = kLargest) const;
  bool truth() const;
  std::size_t count() const;
  /// Index of something of which there are `size`.
  int index(std::size_t size) const;
  std::vector<int> indices(std::size_t size) const;
  Vec3 vector() const;
  /// A vector of length 1 within 1e-6.
  Vec3 unit_vector() const;

  /// Fails if the object has a member that is not `known`.
  void allow_only(const std::vector<std::string>& known) const;

  /// A boolean, a number, a text or numbers, as options are; nothing for null.
  std::optional<OptionInput> option() const;

  const std::string& source() const { return source_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  const nlohmann::json* value_;
  std::string source_, path_;
};

}  // namespace unseen::io
