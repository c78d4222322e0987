// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "unseen/core/error.h"
#include "unseen/cuboids/evaluate.h"
#include "unseen/io/rgbd.h"
#include "unseen/io/write_png.h"
#include "unseen/report/cuboids_evaluation.h"
#include "unseen/report/cuboids_truth.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("unseen-truth-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                                               testing::UnitTest::GetInstance()->current_test_info()->name());
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

cuboids::SynthView make_view(cuboids::SynthOptions& options) {
  options.scene = "shelf";
  options.view = 3;
  Context context;
  return cuboids::make_scene(options, context).views.front();
}

TEST(TruthFiles, WhatWasWrittenIsRead) {
  cuboids::SynthOptions options;
  const cuboids::SynthView view = make_view(options);
  const Folder folder;
  folder.write("truth.json", cuboids_truth_json(view, cuboids::describe(options)));
  const cuboids::Truth read = read_cuboids_truth(folder.path / "truth.json"), &made = view.truth;
  EXPECT_EQ(read.family, "shelf");
  EXPECT_TRUE(read.stands);
  EXPECT_EQ(read.T_world_camera.rotation, made.T_world_camera.rotation);
  ASSERT_EQ(read.supports.size(), 2u);
  EXPECT_EQ(read.supports[1].kind, cuboids::SupportKind::wall);
  ASSERT_EQ(read.cuboids.size(), made.cuboids.size());
  for (std::size_t i = 0; i < made.cuboids.size(); ++i) {
    EXPECT_EQ(read.cuboids[i].box->center, made.cuboids[i].box->center);
    EXPECT_EQ(read.cuboids[i].box->axes, made.cuboids[i].box->axes);
    EXPECT_EQ(read.cuboids[i].size, made.cuboids[i].size);
    EXPECT_EQ(read.cuboids[i].hidden, made.cuboids[i].hidden);
  }
  ASSERT_EQ(read.contacts.size(), made.contacts.size());
  for (std::size_t i = 0; i < made.contacts.size(); ++i) EXPECT_EQ(read.contacts[i].kind, made.contacts[i].kind);
}

TEST(TruthFiles, AViewIsAFrame) {
  cuboids::SynthOptions options;
  const cuboids::SynthView view = make_view(options);
  const Folder folder;
  folder.write("frame.json", synth_frame_json(view, true));
  io::write_grey_png(folder.path / "depth.png", 640, 480, synth_depth_pixels(view));
  io::write_color_png(folder.path / "color.png", 640, 480, view.color);
  io::write_grey_png(folder.path / "masks.png", 640, 480, view.masks);
  const RgbdFrame frame = io::read_rgbd_frame(folder.path);
  ASSERT_EQ(frame.depth.size(), view.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    ASSERT_NEAR(frame.depth[i], view.depth[i], 0.51 / kSynthDepthScale);
    ASSERT_EQ(frame.masks[i], view.masks[i]);
    ASSERT_EQ(frame.color[i], view.color[i]);
  }
}

TEST(TruthFiles, MeasuredSizesTakeTheirPlaceFromLabels) {
  const Folder folder;
  const fs::path frame = folder.path / "two_boxes";
  fs::create_directories(frame);
  std::vector<std::uint16_t> depth(64 * 48, 1000), labels(64 * 48, 1);
  for (int i = 0; i < 64 * 48; ++i) {
    if (i % 64 < 10) labels[i] = 20;
    if (i % 64 > 50) labels[i] = i % 2 ? 30 : 31;
  }
  io::write_grey_png(frame / "depth.png", 64, 48, depth);
  io::write_grey_png(frame / "label.png", 64, 48, labels);
  std::ofstream(frame / "frame.json") << R"({"depth": "depth.png", "depth_scale": 1000,
    "camera": {"fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5}})";
  folder.write("sizes.json", R"({"dims_mm": {"A": [60, 200, 100], "B": [50, 50, 50]},
    "frames": {"two_boxes": {"obj": {"20": "A", "30": "B"}, "edges": [[20, 1], [30, 20]]}}})");
  const auto hidden = parse_hidden_dimensions("A:60,B:50", "test");
  const cuboids::Truth truth = read_measured_truth(folder.path / "sizes.json", frame, hidden);
  ASSERT_EQ(truth.cuboids.size(), 2u);
  EXPECT_NEAR(truth.cuboids[0].size.x(), 0.2, 1e-12);
  EXPECT_EQ(truth.cuboids[0].seen, Vec3(1, 1, 0));
  EXPECT_EQ(truth.cuboids[0].points.size(), 480u);
  EXPECT_EQ(truth.cuboids[1].points.size(), 13u * 48u);  // both labels of the tens
  ASSERT_EQ(truth.contacts.size(), 2u);
  EXPECT_EQ(truth.contacts[0].b, 0);
  EXPECT_THROW(parse_hidden_dimensions("A", "test"), InputError);
  EXPECT_THROW(parse_hidden_dimensions("A:x", "test"), InputError);
  fs::rename(frame, folder.path / "other");
  EXPECT_THROW(read_measured_truth(folder.path / "sizes.json", folder.path / "other", {}), InputError);
}

TEST(TruthFiles, BrokenTruthNamesTheField) {
  cuboids::SynthOptions options;
  std::string text = cuboids_truth_json(make_view(options), cuboids::describe(options));
  text.replace(text.find("\"fixed\""), 7, "\"glued\"");
  const Folder folder;
  folder.write("truth.json", text);
  try {
    read_cuboids_truth(folder.path / "truth.json");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(e.field.find("kind"), std::string::npos);
  }
}

TEST(TruthFiles, EvaluationHoldsWhatWasMeasured) {
  CuboidsEvaluation e;
  e.scores.contacts_after.f1 = 0.875;
  EXPECT_EQ(evaluation_json(e).find("f1"), std::string::npos);  // no truth: no such score
  EXPECT_EQ(evaluation_table(e).find("87.5 %"), std::string::npos);
  e.truth_path = "truth.json";
  EXPECT_NE(evaluation_json(e).find("\"f1\": 0.875"), std::string::npos);
  EXPECT_EQ(evaluation_json(e).find("referee"), std::string::npos);
  EXPECT_NE(evaluation_table(e).find("87.5 %"), std::string::npos);
}

}  // namespace
}  // namespace unseen::report
