// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The option tables in docs/ are what the program says. UNSEEN_UPDATE_DOCS=1 in the environment writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "unseen/collision/options.h"
#include "unseen/collision/synth.h"
#include "unseen/cuboids/options.h"
#include "unseen/cuboids/synth.h"
#include "unseen/interactions/options.h"
#include "unseen/interactions/scenelets.h"
#include "unseen/interactions/synth.h"
#include "unseen/io/describe.h"
#include "unseen/planes/options.h"
#include "unseen/planes/synth.h"

namespace unseen {
namespace {

std::string page(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Checks, or renews, what stands between <!-- options: NAME --> and <!-- end -->.
void check_table(const std::string& file, const std::string& name, const std::string& table) {
  const std::string path = std::string(UNSEEN_SOURCE_DIR) + "/docs/" + file;
  std::string text = page(path);
  const std::string start = "<!-- options: " + name + " -->\n";
  const std::size_t from = text.find(start);
  ASSERT_NE(from, std::string::npos) << path << " lacks the mark " << start;
  const std::size_t first = from + start.size(), end = text.find("<!-- end -->", first);
  ASSERT_NE(end, std::string::npos);
  if (std::getenv("UNSEEN_UPDATE_DOCS") != nullptr) {
    text.replace(first, end - first, table);
    std::ofstream(path) << text;
    return;
  }
  EXPECT_EQ(text.substr(first, end - first), table) << "run report_tests with UNSEEN_UPDATE_DOCS=1";
}

TEST(Docs, PlanesOptionsAreThoseOfTheProgram) {
  planes::Options options;
  check_table("planes.md", "planes", markdown(planes::describe(options)));
}

TEST(Docs, ReadOptionsAreThoseOfTheProgram) {
  io::ReadOptions options;
  check_table("planes.md", "input", markdown(io::describe(options)));
}

TEST(Docs, SynthOptionsAreThoseOfTheProgram) {
  planes::SynthOptions options;
  check_table("planes.md", "synth planes", markdown(planes::describe(options)));
}

TEST(Docs, CuboidsOptionsAreThoseOfTheProgram) {
  cuboids::Options options;
  check_table("cuboids.md", "cuboids", markdown(cuboids::describe(options)));
}

TEST(Docs, CollisionOptionsAreThoseOfTheProgram) {
  collision::Options options;
  check_table("collision.md", "collision", markdown(collision::describe(options)));
}

TEST(Docs, SynthCollisionOptionsAreThoseOfTheProgram) {
  collision::SynthOptions options;
  check_table("collision.md", "synth collision", markdown(collision::describe(options)));
}

TEST(Docs, SynthCuboidsOptionsAreThoseOfTheProgram) {
  cuboids::SynthOptions options;
  check_table("cuboids.md", "synth cuboids", markdown(cuboids::describe(options)));
}

TEST(Docs, InteractionsOptionsAreThoseOfTheProgram) {
  interactions::Options options;
  check_table("interactions.md", "interactions", markdown(interactions::describe(options)));
}

TEST(Docs, SceneletOptionsAreThoseOfTheProgram) {
  interactions::SceneletOptions options;
  check_table("interactions.md", "scenelets build", markdown(interactions::describe(options)));
}

TEST(Docs, SynthInteractionsOptionsAreThoseOfTheProgram) {
  interactions::SynthOptions options;
  check_table("interactions.md", "synth interactions", markdown(interactions::describe(options)));
}

}  // namespace
}  // namespace unseen
