// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/retrieval.h"

#include <gtest/gtest.h>

#include "cuboids/furniture_fixture.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

using namespace furniture_fixture;

/// Points of an object in a repository's own unit and pose.
RetrievalModel model(const std::string& name, const std::vector<OrientedBox>& boxes, double yaw, double unit) {
  RetrievalModel out{name, samples(moved(boxes, upright(yaw, {1, 2, 3})), 6000, 1)};
  for (Vec3& p : out.points) p *= unit;
  return out;
}

std::vector<RetrievalModel> repository() {
  return {model("block", {box_at({0, 0, 0}, {0.5, 0.5, 0.9})}, 0.2, 1.0), model("chair", chair(), 1.75, 40.0),
          model("sofa", sofa(), 0.0, 1000.0), model("stool", {chair()[0]}, 0.0, 1.0),
          model("table", table(), 0.9, 0.01)};
}

/// Boxes as they are measured: a little off, and of one structure.
Completion scene_of(std::vector<OrientedBox> boxes) {
  Random random(3);
  for (OrientedBox& box : boxes)
    for (int k = 0; k < 3; ++k) box.half_size[k] *= random.uniform(0.97, 1.03);
  Completion scene = photo_fixture::scene_of(boxes);
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    Contact contact;
    contact.a = 1;
    contact.b = static_cast<int>(i) + 1;
    contact.kind = ContactKind::fixed;
    scene.contacts.push_back(contact);
  }
  return scene;
}

TEST(Retrieval, RanksTheRightModelFirst) {
  const std::vector<RetrievalModel> models = repository();
  const RigidTransform T = upright(0.6, {0.4, 0.2, 0});
  for (const auto& [name, object] : {std::pair{"chair", chair()}, {"sofa", sofa()}, {"table", table()}}) {
    Context context;
    const Retrieval found = retrieve_models(scene_of(moved(object, T)), models, {}, context);
    ASSERT_EQ(found.ranked.size(), models.size());
    EXPECT_EQ(models[found.ranked[0].model].name, name);
    EXPECT_GT(found.ranked[0].score, found.ranked[1].score + 0.1);
    EXPECT_NEAR(found.ranked[0].score, found.ranked[0].structure_share + found.ranked[0].model_share, 1e-12);
  }
}

TEST(Retrieval, LaysTheChairIntoItsStructure) {
  const RigidTransform T = upright(-2.2, {0.4, 0.2, 0}), T_model = upright(1.75, {1, 2, 3});
  Context context;
  const Retrieval found = retrieve_models(scene_of(moved(chair(), T)), {repository()[1]}, {}, context);
  const RetrievedModel& best = found.ranked[0];
  EXPECT_NEAR(best.scale, 1.0 / 40.0, 0.05 / 40.0);
  for (const Vec3& p : {Vec3(0.2, 0.2, 0.85), Vec3(-0.2, -0.19, 0.02), Vec3(0.0, 0.0, 0.45)})  // back, leg, seat
    EXPECT_LT((best.T_world_model * (best.scale * (40.0 * (T_model * p))) - T * p).norm(), 0.03);
}

TEST(Retrieval, TakesTheLargestStructureOrTheOneAskedFor) {
  Completion scene = scene_of(chair());
  Cuboid other;
  other.id = 50;
  other.box = box_at({2, 0, 0}, {0.1, 0.1, 0.1});
  scene.cuboids.push_back(other);
  EXPECT_EQ(largest_structure(scene), (std::vector<int>{1, 2, 3, 4, 5, 6}));
  RetrievalOptions options;
  options.ids = {50};
  Context context;
  const Retrieval found = retrieve_models(scene, repository(), options, context);
  EXPECT_EQ(found.ids, std::vector<int>{50});
  options.ids = {51};
  EXPECT_THROW(retrieve_models(scene, repository(), options, context), InputError);
}

TEST(Retrieval, IsTheSameAtAnyThreadCount) {
  const Completion scene = scene_of(chair());
  std::vector<std::vector<double>> scores;
  for (const int threads : {1, 2, 4}) {
    Context context;
    context.threads = threads;
    scores.emplace_back();
    for (const RetrievedModel& m : retrieve_models(scene, repository(), {}, context).ranked) scores.back().push_back(m.score);
  }
  EXPECT_EQ(scores[0], scores[1]);
  EXPECT_EQ(scores[0], scores[2]);
}

TEST(Retrieval, RefusesModelsWithoutExtentAndEmptyScenes) {
  Context context;
  EXPECT_THROW(retrieve_models(scene_of(chair()), {{"point", std::vector<Vec3>(10, Vec3::Zero())}}, {}, context), InputError);
  EXPECT_THROW(retrieve_models({}, repository(), {}, context), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
