// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/page.h"

#include <stdexcept>
#include <string_view>

#include "report/html.h"

// The built page of viewer/ as the assembler takes it in.
__asm__(
    ".section .rodata\n"
    ".global unseen_page_begin\n"
    ".global unseen_page_end\n"
    "unseen_page_begin:\n"
    ".incbin \"" UNSEEN_PAGE "\"\n"
    "unseen_page_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" const char unseen_page_begin[], unseen_page_end[];

namespace unseen::report {
namespace {

/// The page's text up to a mark; what follows it remains in `rest`.
std::string_view up_to(std::string_view& rest, std::string_view mark) {
  const std::size_t at = rest.find(mark);
  if (at == std::string_view::npos) throw std::logic_error("the built page lacks its mark " + std::string(mark));
  const std::string_view before = rest.substr(0, at);
  rest.remove_prefix(at + mark.size());
  return before;
}

}  // namespace

std::string page_of(const std::string& title, const std::vector<std::string>& scenes) {
  std::string_view rest(unseen_page_begin, static_cast<std::size_t>(unseen_page_end - unseen_page_begin));
  std::string page(up_to(rest, "<!--unseen:title-->"));
  page += escape(title);
  page += up_to(rest, "<!--unseen:scenes-->");
  for (const std::string& scene : scenes)
    page.append("<script type=\"text/plain\" class=\"unseen-scene\">").append(scene).append("</script>\n");
  return page.append(rest);
}

}  // namespace unseen::report
