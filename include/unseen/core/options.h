// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace unseen {

/// The one description of an option: it feeds the command line, the config file, Python keywords, `--help`
/// and the table in docs/. Values outside are in the option's own unit (degrees for angles).
struct Option {
  using Target = std::variant<bool*, int*, double*, std::string*, std::optional<double>*, std::vector<double>*>;

  std::string name;  ///< snake_case; the flag is the same with dashes
  Target target;     ///< the field it sets
  std::string unit;  ///< "m", "deg", "1", … or empty
  std::string help;
  double min = -std::numeric_limits<double>::infinity();  ///< legal range, ends included
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};  ///< for strings: the legal values
  std::vector<std::string> parts = {};  ///< for lists of as many numbers: what each is; empty = as many as one likes
  bool rising = false;                  ///< each of them below the next

  std::string flag() const;
  /// The current value as text, as a config file would hold it ("" for an unset optional).
  std::string text() const;
  /// "0…1", "above 0" (if min is the smallest positive number), "one of local, exact", … or empty.
  std::string range() const;
};

/// A value on its way into an option, whatever it came from.
using OptionInput = std::variant<bool, double, std::string, std::vector<double>>;

/// The options of one capability, in the order in which they are shown.
class OptionTable {
 public:
  Option& add(Option option);
  const std::vector<Option>& all() const { return options_; }

  /// Sets an option after checking type, range and choice. `source` (a file, or "command line") starts the
  /// message of the InputError that a bad value or an unknown name gives; unknown names list the known ones.
  void set(const std::string& name, const OptionInput& value, const std::string& source);
  /// The same from text, as a command line gives it: "0.05", "true", "60,90".
  void set_text(const std::string& name, const std::string& text, const std::string& source);
  /// Throws like set() if a value that an option holds, and code may have set, is not legal.
  void check(const std::string& source);
  /// The current value of an option as text; throws like set() if there is none of that name.
  std::string text_of(const std::string& name) const { return find(name, "").text(); }

 private:
  const Option& find(const std::string& name, const std::string& source) const;
  std::vector<Option> options_;
};

/// Values set in code meet the same limits as those of a file or a command line: throws like OptionTable::set().
template <class Options>
void check_options(Options options, const std::string& source = "options") {
  describe(options).check(source);
}

/// The table as Markdown: option, unit, default, range, what it does.
std::string markdown(const OptionTable& table);

}  // namespace unseen
