// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_page.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "report/html.h"
#include "report/sample.h"
#include "unseen/planes/options.h"

namespace unseen::report {
namespace {

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + of.size())) ++count;
  return count;
}

std::string page_of(const planes::Arrangement& a, const std::string& path) {
  planes::Options options;
  PointSample points;
  for (std::size_t p = 0; p < a.planes.size(); ++p)
    if (!a.planes[p].polygon.empty())
      points.add(a.planes[p].polygon[0], std::vector<int>(4, static_cast<int>(p)));
  return planes_page(a, {path, ""}, planes::describe(options), "unseen planes '" + path + "' -o out", points);
}

TEST(Escape, ReplacesWhatHtmlWouldRead) {
  EXPECT_EQ(escape("<a href=\"x\" b='y'>&amp;"), "&lt;a href=&quot;x&quot; b=&#39;y&#39;&gt;&amp;amp;");
  EXPECT_EQ(escape("Häuser 点云 🏠"), "Häuser 点云 🏠");
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(escape("a\x01"
                   "b\xff"
                   "c\xc0\xaf"
                   "d\xe2\x82"),
            "a" + bad + "b" + bad + "c" + bad + bad + "d" + bad + bad);
  EXPECT_EQ(escape("\xed\xa0\x80"), bad + bad + bad);
}

TEST(Page, HostileNamesStayText) {
  planes::Arrangement a = sample_room();
  a.planes[3].tag = "<svg onload=alert(2)>";
  a.summary.warnings.push_back("</p><script>alert(3)</script>");
  const std::string page = page_of(a, "x/<script>alert(1)<\\script>\"'&.ply");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<svg onload"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)"), std::string::npos);
}

TEST(Page, StandsAloneAndShowsEveryPlane) {
  const std::string page = page_of(sample_room(), "room.ply");
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  EXPECT_NE(page.find("<title>Planes of room.ply</title>"), std::string::npos);
  EXPECT_EQ(occurrences(page, "<svg "), 3u);
  EXPECT_EQ(occurrences(page, "class=\"plane\""), 10u);
  EXPECT_EQ(page.find("-0.0000"), std::string::npos);
  EXPECT_NE(page.find("normals unusable: &lt;re-estimated&gt;"), std::string::npos);
  for (const char* tag : {"table", "div", "figure", "svg", "pre", "p", "h2", "tr", "span"})
    EXPECT_EQ(
        occurrences(page, std::string("<") + tag + ">") + occurrences(page, std::string("<") + tag + " "),
        occurrences(page, std::string("</") + tag + ">"))
        << tag;
}

TEST(Page, CeilingsGoOnlyWhereTheyHideAFloor) {
  planes::Arrangement a = sample_room();
  a.planes[3].tag = "ceiling";
  EXPECT_EQ(occurrences(page_of(a, "room.ply"), "class=\"plane\""), 8u);
  a.planes[0].tag = "";
  EXPECT_EQ(occurrences(page_of(a, "roof.ply"), "class=\"plane\""), 10u);
}

TEST(Page, DrawingsAndNothingAreDrawn) {
  const std::string drawing = page_of(sample_drawing(), "plan.png");
  EXPECT_EQ(occurrences(drawing, "class=\"segment\""), 2u);
  planes::Arrangement nothing;
  nothing.summary.status = Status::infeasible;
  const std::string page = page_of(nothing, "");
  EXPECT_NE(page.find("Status: infeasible"), std::string::npos);
  for (const char* number : {"nan ", ">nan", "inf ", ">inf", "\"nan", "\"inf"})
    EXPECT_EQ(page.find(number), std::string::npos) << number;
}

}  // namespace
}  // namespace unseen::report
