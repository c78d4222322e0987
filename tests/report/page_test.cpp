// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/page.h"

#include <gtest/gtest.h>

#include "report/html.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {
namespace {

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + of.size())) ++count;
  return count;
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

TEST(Page, HoldsItsScenesAndATitleThatStaysText) {
  const std::string page = page_of("a <b> & c", {"AAAA", "BBBB"});
  EXPECT_EQ(occurrences(page, "<title>a &lt;b&gt; &amp; c</title>"), 1u);
  EXPECT_EQ(occurrences(page, "class=\"unseen-scene\">AAAA</script>"), 1u);
  EXPECT_LT(page.find("AAAA"), page.find("BBBB"));
  EXPECT_EQ(occurrences(page, "<!--unseen:"), 0u);
  EXPECT_EQ(page.substr(0, 15), "<!DOCTYPE html>");
}

TEST(Page, AsksForNothing) {
  const std::string page = page_of("", {});
  for (const char* way : {"src=\"http", "href=\"http", "@import", "url(http"}) EXPECT_EQ(occurrences(page, way), 0u) << way;
  EXPECT_GE(occurrences(page, "default-src 'none'"), 1u);
}

TEST(PointSample, ThinsEvenlyAndSaysSo) {
  PointSample sample;
  sample.limit = 100;
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i, 0, 0);
  sample.add(points, std::vector<int>(1000, 3));
  EXPECT_EQ(sample.step, 16u);
  EXPECT_EQ(sample.positions.size(), 63u);
  const PointSample fewer = thinned(sample, 20);
  EXPECT_EQ(fewer.step, 64u);
  EXPECT_EQ(fewer.seen, 1000u);
  for (std::size_t i = 0; i < fewer.positions.size(); ++i) EXPECT_EQ(fewer.positions[i].x(), 64.0 * static_cast<double>(i));
}

}  // namespace
}  // namespace unseen::report
