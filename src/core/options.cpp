// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/overload.h"
#include "unseen/core/error.h"

namespace unseen {
namespace {

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> numbers(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const std::size_t comma = text.find(',');
    const auto value = number(text.substr(0, comma));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

std::string found(const OptionInput& value) {
  return std::visit(Overload{[](bool b) { return std::string(b ? "true" : "false"); },
                             [](double d) { return fmt::format("{}", d); },
                             [](const std::string& s) { return "\"" + s + "\""; },
                             [](const std::vector<double>& v) { return fmt::format("{}", v); }},
                    value);
}

/// Whether a list has the numbers that its option takes; none at all is that nothing is set.
bool fits(const std::vector<double>& list, const Option& option) {
  if (list.empty() || option.parts.empty()) return true;
  const auto stays = std::adjacent_find(list.begin(), list.end(), [](double a, double b) { return !(a < b); });
  return list.size() == option.parts.size() && (!option.rising || stays == list.end());
}

/// "2 numbers nearest,farthest with nearest < farthest"
std::string parts_of(const Option& option) {
  const std::string order = option.rising ? fmt::format(" with {}", fmt::join(option.parts, " < ")) : "";
  return fmt::format("{} numbers {}{}", option.parts.size(), fmt::join(option.parts, ","), order);
}

}  // namespace

std::string Option::flag() const {
  std::string flag = "--" + name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string Option::text() const {
  return std::visit(
      Overload{[](const bool* b) { return std::string(*b ? "true" : "false"); },
               [](const int* i) { return std::to_string(*i); },
               [](const double* d) { return fmt::format("{}", *d); },
               [](const std::string* s) { return *s; },
               [](const std::optional<double>* d) { return *d ? fmt::format("{}", **d) : std::string(); },
               [](const std::vector<double>* v) { return fmt::format("{}", fmt::join(*v, ",")); }},
      target);
}

std::string Option::range() const {
  if (std::holds_alternative<bool*>(target) || (std::holds_alternative<std::string*>(target) && choices.empty())) return "";
  if (!choices.empty()) return fmt::format("one of {}", fmt::join(choices, ", "));
  const bool low = std::isfinite(min), high = std::isfinite(max);
  const bool positive = min == std::numeric_limits<double>::min();
  if (positive) return high ? fmt::format("above 0, at most {}", max) : "above 0";
  if (low && high) return fmt::format("{}…{}", min, max);
  if (low) return fmt::format("at least {}", min);
  if (high) return fmt::format("at most {}", max);
  return "";
}

Option& OptionTable::add(Option option) { return options_.emplace_back(std::move(option)); }

const Option& OptionTable::find(const std::string& name, const std::string& source) const {
  for (const Option& option : options_)
    if (option.name == name) return option;
  std::vector<std::string> known;
  for (const Option& option : options_) known.push_back(option.name);
  throw InputError(source, "option", "\"" + name + "\"", fmt::format("one of {}", fmt::join(known, ", ")));
}

void OptionTable::set(const std::string& name, const OptionInput& value, const std::string& source) {
  const Option& option = find(name, source);
  const auto fail = [&](const std::string& expected) {
    throw InputError(source, option.name, found(value), expected);
  };
  const auto checked = [&](double v) {
    if (!std::isfinite(v) || v < option.min || v > option.max)
      fail(option.range().empty() ? "a finite number" : "a number " + option.range());
    return v;
  };
  const auto as_number = [&] {
    if (!std::holds_alternative<double>(value)) fail("a number " + option.range());
    return checked(std::get<double>(value));
  };
  std::visit(Overload{[&](bool* target) {
                        if (!std::holds_alternative<bool>(value)) fail("true or false");
                        *target = std::get<bool>(value);
                      },
                      [&](int* target) {
                        const double v = as_number();
                        if (v != std::floor(v) || std::abs(v) > 2e9) fail("a whole number " + option.range());
                        *target = static_cast<int>(v);
                      },
                      [&](double* target) { *target = as_number(); },
                      [&](std::optional<double>* target) { *target = as_number(); },
                      [&](std::string* target) {
                        if (!std::holds_alternative<std::string>(value)) fail("text");
                        const std::string& text = std::get<std::string>(value);
                        if (!option.choices.empty() &&
                            std::find(option.choices.begin(), option.choices.end(), text) == option.choices.end())
                          fail(option.range());
                        *target = text;
                      },
                      [&](std::vector<double>* target) {
                        const double* one = std::get_if<double>(&value);
                        const auto* many = std::get_if<std::vector<double>>(&value);
                        if (one == nullptr && many == nullptr) fail("numbers " + option.range());
                        const std::vector<double> list = one ? std::vector<double>{*one} : *many;
                        for (const double v : list) checked(v);
                        if (!fits(list, option)) fail(parts_of(option));
                        *target = list;
                      }},
             option.target);
}

void OptionTable::set_text(const std::string& name, const std::string& text, const std::string& source) {
  const Option& option = find(name, source);
  OptionInput value = text;
  if (std::holds_alternative<bool*>(option.target)) {
    if (text == "true" || text == "false") value = text == "true";
  } else if (std::holds_alternative<std::vector<double>*>(option.target)) {
    if (auto list = numbers(text)) value = std::move(*list);
  } else if (!std::holds_alternative<std::string*>(option.target)) {
    if (auto v = number(text)) value = *v;
  }
  set(name, value, source);
}

void OptionTable::check(const std::string& source) {
  for (const Option& option : options_)
    if (const std::string text = option.text(); !text.empty() || !option.choices.empty()) set_text(option.name, text, source);
}

std::string markdown(const OptionTable& table) {
  std::string text = "| option | unit | default | range | what it does |\n| --- | --- | --- | --- | --- |\n";
  for (const Option& option : table.all())
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", option.flag(), option.unit,
                        option.text().empty() ? "–" : option.text(), option.range(), option.help);
  return text;
}

}  // namespace unseen
