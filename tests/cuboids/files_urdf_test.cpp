// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// scene.urdf read back by a small reader of XML: a tree of links whose places in the world are those of the boxes.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cuboids/files_sample.h"
#include "unseen/report/cuboids_files.h"

namespace unseen::cuboids {
namespace {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;

  const Element& child(const std::string& wanted) const {
    for (const Element& c : children)
      if (c.name == wanted) return c;
    throw std::runtime_error(name + " lacks " + wanted);
  }
};

/// Elements and attributes only; throws std::runtime_error at whatever is not well-formed.
class Xml {
 public:
  explicit Xml(const std::string& text) : text_(text) {}
  Element document() {
    if (text_.rfind("<?xml", 0) == 0) at_ = text_.find("?>") + 2;
    blanks();
    Element root = element();
    blanks();
    if (at_ != text_.size()) fail("text after the end");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at " + std::to_string(at_));
  }
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void expect(const std::string& token) {
    if (text_.compare(at_, token.size(), token) != 0) fail("no " + token);
    at_ += token.size();
  }
  void blanks() {
    while (std::isspace(static_cast<unsigned char>(here()))) ++at_;
  }
  std::string word() {
    const std::size_t start = at_;
    while (std::isalnum(static_cast<unsigned char>(here())) || here() == '_') ++at_;
    if (at_ == start) fail("no name");
    return text_.substr(start, at_ - start);
  }
  Element element() {
    Element e;
    expect("<");
    e.name = word();
    for (blanks(); here() != '/' && here() != '>'; blanks()) {
      const std::string key = word();
      expect("=\"");
      const std::size_t end = text_.find_first_of("\"<", at_);
      if (end == std::string::npos || text_[end] == '<') fail("an open attribute");
      if (!e.attributes.emplace(key, text_.substr(at_, end - at_)).second) fail("a double attribute");
      at_ = end + 1;
    }
    if (here() == '/') {
      expect("/>");
      return e;
    }
    expect(">");
    for (blanks(); text_.compare(at_, 2, "</") != 0; blanks()) e.children.push_back(element());
    expect("</" + e.name + ">");
    return e;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

Vec3 vector_of(const std::string& text) {
  std::istringstream in(text);
  Vec3 v;
  if (!(in >> v.x() >> v.y() >> v.z())) throw std::runtime_error("not three numbers: " + text);
  return v;
}

/// The tree of a robot.
struct Robot {
  std::map<std::string, Element> links;
  std::map<std::string, std::pair<std::string, std::string>> parent_and_type;
  std::map<std::string, RigidTransform> place;

  explicit Robot(const std::string& text) {
    const Element root = Xml(text).document();
    EXPECT_EQ(root.name, "robot");
    std::set<std::string> joints;
    for (const Element& e : root.children) {
      if (e.name == "link") {
        EXPECT_TRUE(links.emplace(e.attributes.at("name"), e).second) << "two links of a name";
      }
      if (e.name != "joint") continue;
      EXPECT_TRUE(joints.insert(e.attributes.at("name")).second) << "two joints of a name";
      const std::string child = e.child("child").attributes.at("link"),
                        parent = e.child("parent").attributes.at("link");
      EXPECT_TRUE(parent_and_type.emplace(child, std::pair(parent, e.attributes.at("type"))).second)
          << child << " has two parents";
      const Vec3 rpy = vector_of(e.child("origin").attributes.at("rpy"));
      place[child] = {(Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
                       Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
                          .toRotationMatrix(),
                      vector_of(e.child("origin").attributes.at("xyz"))};
    }
  }
  RigidTransform in_world(const std::string& link) const {
    RigidTransform t;
    std::string at = link;
    for (std::size_t steps = 0; at != "world"; ++steps) {
      if (steps > links.size()) throw std::runtime_error(link + " is in a loop");
      t = place.at(at) * t;
      at = parent_and_type.at(at).first;
    }
    return t;
  }
};

TEST(Urdf, BoxesStandWhereTheyAre) {
  const Completion c = sample_completion();
  const Robot robot(report::cuboids_urdf(c, 0.7));
  EXPECT_EQ(robot.links.size(), 1 + 2 + 3u);
  EXPECT_EQ(robot.parent_and_type.size(), 5u);
  for (const Cuboid& cuboid : c.cuboids) {
    const std::string name = "box_" + std::to_string(cuboid.id);
    const RigidTransform t = robot.in_world(name);
    EXPECT_LT((t.translation - cuboid.box.center).norm(), 1e-7);
    EXPECT_LT((t.rotation - cuboid.box.axes).norm(), 1e-7);
    const Element& link = robot.links.at(name);
    EXPECT_LT((vector_of(link.child("collision").child("geometry").child("box").attributes.at("size")) -
               2 * cuboid.box.half_size)
                  .norm(),
              1e-7);
    EXPECT_NEAR(std::stod(link.child("inertial").child("mass").attributes.at("value")), cuboid.mass(), 1e-7);
    const double width = 2 * cuboid.box.half_size.x(), depth = 2 * cuboid.box.half_size.y();
    EXPECT_NEAR(std::stod(link.child("inertial").child("inertia").attributes.at("izz")),
                cuboid.mass() * (width * width + depth * depth) / 12, 1e-9);
  }
  EXPECT_EQ(robot.parent_and_type.at("box_2"), (std::pair<std::string, std::string>("world", "floating")));
  EXPECT_EQ(robot.parent_and_type.at("box_7"), (std::pair<std::string, std::string>("support_1", "fixed")));
  EXPECT_EQ(robot.parent_and_type.at("support_0").second, "fixed");
}

TEST(Urdf, CyclesOfFixedContactsBecomeATree) {
  Completion c = sample_tower(4, 0.01);
  c.cuboids[1].box.axes = Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()).toRotationMatrix();  // pitch at its end
  c.cuboids[2].box.axes = Eigen::AngleAxisd(2.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  c.contacts.push_back(sample_contact(4, 1, Vec3::Zero(), 0.01, 1));
  for (std::size_t k = 1; k < c.contacts.size(); ++k) c.contacts[k].kind = ContactKind::fixed;
  const Robot robot(report::cuboids_urdf(c, 0.7));
  int floating = 0;
  for (const auto& [child, joint] : robot.parent_and_type) floating += joint.second == "floating";
  EXPECT_EQ(floating, 1);
  for (const Cuboid& cuboid : c.cuboids) {
    const RigidTransform t = robot.in_world("box_" + std::to_string(cuboid.id));
    EXPECT_LT((t.translation - cuboid.box.center).norm() + (t.rotation - cuboid.box.axes).norm(), 1e-6);
  }
}

TEST(Urdf, SupportsWithoutEndAreLargeEnough) {
  const Completion c = sample_tower(3, 0.02);
  const Robot robot(report::cuboids_urdf(c, 0.7));
  const RigidTransform ground = robot.in_world("support_0");
  const Vec3 half =
      0.5 *
      vector_of(robot.links.at("support_0").child("collision").child("geometry").child("box").attributes.at("size"));
  EXPECT_NEAR((ground * Vec3(0, 0, half.z())).z(), 0.0, 1e-9);  // its upper face is the plane
  for (const Cuboid& cuboid : c.cuboids) {
    const Vec3 p = ground.inverse() * cuboid.box.center;
    EXPECT_LT(std::abs(p.x()), half.x());
    EXPECT_LT(std::abs(p.y()), half.y());
  }
}

}  // namespace
}  // namespace unseen::cuboids
