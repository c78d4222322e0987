// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/html.h"

#include <cstddef>

namespace unseen::report {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ground: #fff; --ink: #1b1f24; --quiet: #5c6670; --line: #d8dde3; --card: #f5f7f9; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14171a; --ink: #e6e9ec; --quiet: #9aa5b0; --line: #343b42; --card: #1d2226; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 70rem; padding: 1rem; background: var(--ground); color: var(--ink);
       font: 16px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.5rem; margin: .5rem 0; } h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
p { margin: .5rem 0; } .quiet { color: var(--quiet); }
pre { background: var(--card); padding: .75rem; border-radius: .4rem; white-space: pre-wrap; margin: .5rem 0; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(8rem, 1fr)); gap: .5rem; margin: 1rem 0; }
.figures div { background: var(--card); border-radius: .4rem; padding: .5rem .75rem; color: var(--quiet); }
.figures b { display: block; font-size: 1.3rem; color: var(--ink); }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1rem; }
figure { margin: 0; } figcaption { color: var(--quiet); font-size: .9rem; }
svg { width: 100%; height: auto; background: var(--card); border-radius: .4rem; }
svg .plane { fill-rule: evenodd; fill-opacity: .85; stroke: var(--ink); stroke-width: .7; stroke-linejoin: round; }
svg .segment { stroke-width: 3; stroke-linecap: round; fill: none; }
svg .dots { stroke-width: 2; stroke-linecap: round; fill: none; }
svg text { font: 600 13px system-ui, sans-serif; text-anchor: middle; dominant-baseline: middle; fill: #000;
           stroke: #fff; stroke-width: 3; paint-order: stroke; }
.wide { overflow-x: auto; overflow-wrap: normal; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); white-space: nowrap; }
.swatch { display: inline-block; width: .8em; height: .8em; border-radius: .2em; margin-right: .4em; }
.warning { border-left: .25rem solid #d55e00; padding-left: .75rem; }
)css";

/// Length of the UTF-8 character that starts at `i`, or 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  if (first == 0xe0 && byte(i + 1) < 0xa0) return 0;  // overlong
  if (first == 0xed && byte(i + 1) > 0x9f) return 0;  // surrogates
  if ((first == 0xf0 && byte(i + 1) < 0x90) || (first == 0xf4 && byte(i + 1) > 0x8f)) return 0;
  return length;
}

std::string row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  return text + "</tr>\n";
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const char c = text[i];
    if (length == 0 || static_cast<unsigned char>(c) == 0x7f ||
        (length == 1 && static_cast<unsigned char>(c) < 0x20)) {
      out += "\xef\xbf\xbd";  // U+FFFD
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<div class=\"wide\"><table>\n";
  if (!head.empty()) text += "<thead>" + row(head, "th") + "</thead>\n";
  text += "<tbody>\n";
  for (const auto& cells : rows) text += row(cells, "td");
  return text + "</tbody></table></div>\n";
}

std::string html_page(std::string_view title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
         "'unsafe-inline'\">\n"
         "<title>" +
         escape(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

}  // namespace unseen::report
