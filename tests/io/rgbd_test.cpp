// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/rgbd.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "unseen/core/error.h"
#include "unseen/io/write_image.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;
constexpr int kWidth = 8, kHeight = 6;
constexpr const char* kCamera = R"("camera": {"fx": 10, "fy": 11, "cx": 3.5, "cy": 2.5})";

/// A frame of 8 × 6 pixels in a folder of its own; depth in millimetres is 1000 + 10 · pixel, with holes.
class Rgbd : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "unseen-rgbd-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    cv::Mat depth(kHeight, kWidth, CV_16UC1), color(kHeight, kWidth, CV_8UC3), masks(kHeight, kWidth, CV_8UC1);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      depth.at<std::uint16_t>(i / kWidth, i % kWidth) = static_cast<std::uint16_t>(i == 0   ? 0
                                                                                   : i == 1 ? 65535
                                                                                            : 1000 + 10 * i);
      color.at<cv::Vec3b>(i / kWidth, i % kWidth) = {1, 2, static_cast<std::uint8_t>(i)};
      masks.at<std::uint8_t>(i / kWidth, i % kWidth) = static_cast<std::uint8_t>(i % 3);
    }
    depth_ = depth;
    cv::imwrite(file("depth.png"), depth);
    cv::imwrite(file("color.png"), color);
    cv::imwrite(file("masks.png"), masks);
    frame("\"depth\": \"depth.png\"");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  void frame(const std::string& fields, const std::string& camera = kCamera) const {
    write("frame.json", "{" + fields + (camera.empty() ? "" : ", " + camera) + "}");
  }
  /// Reads frame.json, which must fail in `field` with one line that holds all the words.
  void refused(const std::string& field, const std::vector<std::string>& words = {}) const {
    try {
      read_rgbd_frame(file("frame.json"));
      ADD_FAILURE() << "taken: " << field;
    } catch (const InputError& e) {
      EXPECT_EQ(e.field, field) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      EXPECT_FALSE(e.found.empty()) << e.what();
      EXPECT_FALSE(e.expected.empty()) << e.what();
      for (const std::string& word : words)
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what() << " lacks " << word;
    }
  }
  void refused_fields(const std::string& more, const std::string& field,
                      const std::vector<std::string>& words = {}) const {
    frame("\"depth\": \"depth.png\", " + more);
    refused(field, words);
  }
  void expect_depths(const RgbdFrame& f) const {
    ASSERT_EQ(f.depth.size(), static_cast<std::size_t>(kWidth * kHeight));
    EXPECT_EQ(f.depth[0], 0.0f);
    EXPECT_EQ(f.depth[1], 0.0f);
    for (std::size_t i = 2; i < f.depth.size(); ++i) EXPECT_NEAR(f.depth[i], 1.0 + 0.01 * static_cast<double>(i), 1e-4);
  }

  fs::path folder_;
  cv::Mat depth_;
};

TEST_F(Rgbd, EverythingOfAFrameFile) {
  frame(R"("depth": "depth.png", "depth_scale": 1000, "color": "color.png", "masks": "masks.png", "up": [0, -0.8, -0.6],
    "supports": [{"normal": [0, -2, 0], "offset": -3, "kind": "desk"}], "strokes": [{"label": "box", "points": [[0, 0], [7, 5]]}],
    "densities": {"box": 500})");
  const RgbdFrame f = read_rgbd_frame(file("frame.json"));
  expect_depths(f);
  EXPECT_EQ(f.camera.width, kWidth);
  EXPECT_EQ(f.camera.fy, 11);
  EXPECT_EQ(f.color.at(5), (std::array<std::uint8_t, 3>{5, 2, 1}));
  EXPECT_EQ(f.masks.at(5), 2);
  EXPECT_EQ(*f.up, Vec3(0, -0.8, -0.6));
  ASSERT_EQ(f.supports.size(), 1u);
  EXPECT_EQ(f.supports[0].plane.normal, Vec3(0, -1, 0));
  EXPECT_EQ(f.supports[0].plane.offset, -1.5);
  EXPECT_EQ(f.supports[0].kind, "desk");
  ASSERT_EQ(f.strokes.size(), 1u);
  EXPECT_EQ(f.strokes[0].points.at(1), Vec2(7, 5));
  EXPECT_EQ(f.densities.at("box"), 500);
  EXPECT_FALSE(f.is_fused());
}

TEST_F(Rgbd, FoldersWithUsualNames) {
  expect_depths(read_rgbd_frame(folder_));  // has a frame.json
  fs::remove(file("frame.json"));
  EXPECT_THROW(read_rgbd_frame(folder_), InputError);  // no intrinsics
  write("camera-intrinsics.txt", "10 0 3.5\n0 11 2.5\n0 0 1\n");
  RgbdFrame f = read_rgbd_frame(folder_);
  expect_depths(f);
  EXPECT_EQ(f.camera.fy, 11);
  EXPECT_EQ(f.color.size(), f.depth.size());
  write("intrinsics.json", R"({"width": 8, "height": 6, "intrinsic_matrix": [12, 0, 0, 0, 13, 0, 3.5, 2.5, 1]})");
  f = read_rgbd_frame(folder_);
  EXPECT_EQ(f.camera.fx, 12);
  EXPECT_EQ(f.camera.fy, 13);
  EXPECT_EQ(f.camera.cx, 3.5);
  EXPECT_EQ(f.camera.cy, 2.5);
  write("intrinsics.json", R"({"intrinsic_matrix": [12, 0, 3.5, 0, 13, 2.5, 0, 0, 1]})");
  EXPECT_THROW(read_rgbd_frame(folder_), InputError);  // row by row: its principal point would be the corner
  write("intrinsics.json", R"({"intrinsic_matrix": [12, 0, 0, 0, 13, 0, 3.5, 2.5, 1]})");
  fs::remove(file("color.png"));
  fs::rename(file("masks.png"), file("rgb.png"));
  EXPECT_EQ(read_rgbd_frame(folder_).color.at(5), (std::array<std::uint8_t, 3>{2, 2, 2}));
}

TEST_F(Rgbd, TiffOf16BitsAndOfFloats) {
  cv::imwrite(file("depth.tif"), depth_);
  frame("\"depth\": \"depth.tif\"");
  expect_depths(read_rgbd_frame(file("frame.json")));
  cv::Mat metres;
  depth_.convertTo(metres, CV_32F, 1e-3);
  metres.at<float>(0, 1) = std::numeric_limits<float>::quiet_NaN();
  cv::imwrite(file("depth.tif"), metres);
  expect_depths(read_rgbd_frame(file("frame.json")));
  std::ifstream in(file("depth.tif"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const std::size_t kept : {std::size_t{4}, std::size_t{9}, bytes.size() / 2}) {
    write("depth.tif", bytes.substr(0, kept));
    refused("image");
  }
}

TEST_F(Rgbd, ExrOfFloats) {
  std::vector<float> metres;
  for (int i = 0; i < kWidth * kHeight; ++i)
    metres.push_back(i == 0   ? -1.0f
                     : i == 1 ? std::numeric_limits<float>::infinity()
                              : 1.0f + 0.01f * static_cast<float>(i));
  Imf::Header header(kWidth, kHeight);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.channels().insert("A", Imf::Channel(Imf::HALF));
  {
    Imf::OutputFile out(file("depth.exr").c_str(), header);
    Imf::FrameBuffer pixels;
    pixels.insert(
        "Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(metres.data()), sizeof(float), sizeof(float) * kWidth));
    out.setFrameBuffer(pixels);
    out.writePixels(kHeight);
  }
  frame("\"depth\": \"depth.exr\"");
  expect_depths(read_rgbd_frame(file("frame.json")));
  std::ifstream in(file("depth.exr"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t kept = 4; kept < bytes.size(); kept += 7) {
    write("depth.exr", bytes.substr(0, kept));
    EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError) << kept;
  }
  for (std::size_t at = 4; at < bytes.size(); ++at) {  // whatever a byte says, it is read or refused
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x80);
    write("depth.exr", changed);
    try {
      read_rgbd_frame(file("frame.json"));
    } catch (const InputError&) {
    }
  }
}

TEST_F(Rgbd, OrganisedPcdBringsItsCamera) {
  std::string text =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 8\nHEIGHT 6\nPOINTS 48\nDATA ascii\n";
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double z = 1.0 + 0.01 * i, x = (i % kWidth - 3.25) / 20.0 * z, y = (i / kWidth - 2.75) / 25.0 * z;
    text += i < 2 ? "nan nan nan\n" : std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  write("depth.pcd", text);
  frame("\"depth\": \"depth.pcd\"", "");
  const RgbdFrame f = read_rgbd_frame(file("frame.json"));
  expect_depths(f);
  EXPECT_NEAR(f.camera.fx, 20, 1e-2);
  EXPECT_NEAR(f.camera.fy, 25, 1e-2);
  EXPECT_NEAR(f.camera.cx, 3.25, 1e-2);
  EXPECT_NEAR(f.camera.cy, 2.75, 1e-2);
  std::string flat = text;
  flat.replace(flat.find("WIDTH 8\nHEIGHT 6"), 16, "WIDTH 48\nHEIGHT 1");
  write("depth.pcd", flat);
  refused("HEIGHT", {"organised"});
}

TEST_F(Rgbd, FusedCloud) {
  write("cloud.xyz", "0 0 1\n0.1 0 1\n0 0.1 1.5\n");
  frame(R"("cloud": "cloud.xyz", "viewpoint": [0, 0, -1])", "");
  const RgbdFrame f = read_rgbd_frame(file("frame.json"));
  EXPECT_TRUE(f.is_fused());
  EXPECT_EQ(f.cloud.size(), 3u);
  EXPECT_EQ(*f.cloud.viewpoint, Vec3(0, 0, -1));
  frame(R"("cloud": "cloud.xyz")", "");
  refused("viewpoint", {"seen from"});
  frame(R"("cloud": "cloud.xyz", "viewpoint": [0, 0])", "");
  refused("viewpoint");
  frame(R"("cloud": "cloud.xyz", "viewpoint": [0, 0, 0])");
  refused("camera");
  frame(R"("cloud": "cloud.xyz", "viewpoint": [0, 0, 0], "strokes": [])", "");
  refused("strokes");
  write("cloud.xyz", "0 0 1000\n100 0 1000\n0 100 1500\n");
  frame(R"("cloud": "cloud.xyz", "viewpoint": [0, 0, 0])", "");
  refused("points", {"scene of 1e+03 m"});
}

TEST_F(Rgbd, MissingOrWrongFiles) {
  for (const std::string& path : {std::string("nowhere/frame.json"), file("none")})
    EXPECT_THROW(read_rgbd_frame(path), InputError);
  frame("\"color\": \"color.png\"");
  refused("depth", {"depth image"});
  frame("\"depth\": \"none.png\"");
  refused("depth", {"none.png"});
  frame("\"depth\": 7");
  refused("depth", {"text"});
  frame(R"("depth": "")");
  refused("depth");
  frame(R"("depth": "color.png")");
  refused("pixels", {"16 bits"});
  frame(R"("depth": ".")");
  EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError);
  write("broken.png", std::string("\x89PNG\r\n\x1a\n", 8) + "nonsense");
  frame(R"("depth": "broken.png")");
  refused("image");
  write("empty.png", "");
  frame(R"("depth": "empty.png")");
  EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError);
  refused_fields(R"("color": "nocolor.png")", "color", {"nocolor.png"});
  refused_fields(R"("depht": 1)", "depht", {"depth_scale"});
  refused_fields(R"("viewpoint": [0, 0, 0])", "viewpoint");
}

TEST_F(Rgbd, DepthsThatAreNone) {
  for (const std::uint16_t value : {0, 65535}) {
    cv::imwrite(file("depth.png"), cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(value)));
    refused("depth", {"none of 48 pixels", "depth.png"});
  }
  cv::imwrite(file("depth.tif"),
              cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN())));
  frame("\"depth\": \"depth.tif\"");
  refused("depth", {"none of 48 pixels"});
}

TEST_F(Rgbd, WrongUnits) {
  frame(R"("depth": "depth.png", "depth_scale": 1)");
  refused("depth", {"a scene of 1.4", "e+03 m", "depth_scale 1)", "depth_scale 1000 would make"});
  frame(R"("depth": "depth.png", "depth_scale": 100000)");
  refused("depth", {"a scene of 0.0146 m", "depth_scale 1000"});
  cv::Mat metres(kHeight, kWidth, CV_32FC1, cv::Scalar(400.0f));  // all at 400 m
  cv::imwrite(file("depth.tif"), metres);
  frame("\"depth\": \"depth.tif\"");
  refused("depth", {"a scene of 400 m"});
  for (const char* scale : {"0", "-1", "1e400", "\"mm\"", "null", "[1]"}) {
    frame(std::string(R"("depth": "depth.png", "depth_scale": )") + scale);
    EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError) << scale;
  }
}

TEST_F(Rgbd, PicturesOfAnotherSize) {
  cv::imwrite(file("color.png"), cv::Mat(kHeight, kWidth + 1, CV_8UC3, cv::Scalar(1, 2, 3)));
  refused_fields(R"("color": "color.png")", "size", {"color.png", "9 x 6", "8 x 6"});
  cv::imwrite(file("masks.png"), cv::Mat(kHeight + 1, kWidth, CV_16UC1, cv::Scalar(1)));
  refused_fields(R"("masks": "masks.png")", "size", {"masks.png", "8 x 7", "8 x 6"});
}

TEST_F(Rgbd, Intrinsics) {
  frame(R"("depth": "depth.png")", "");
  refused("camera", {"fx, fy, cx and cy"});
  frame(R"("depth": "depth.png")", R"("camera": {"fx": 1, "fy": 2, "cx": 3})");
  refused("camera", {"cy is missing"});
  frame(R"("depth": "depth.png")", R"("camera": {"fx": 0, "fy": 2, "cx": 3, "cy": 3})");
  refused("camera.fx");
  frame(R"("depth": "depth.png")", R"("camera": {"fx": 1, "fy": "2", "cx": 3, "cy": 3})");
  refused("camera.fy");
  frame(R"("depth": "depth.png")", R"("camera": [1, 2, 3, 4])");
  refused("camera");
}

TEST_F(Rgbd, Hints) {
  refused_fields(R"("up": [0, -2, 0])", "up", {"length 2"});
  refused_fields(R"("up": [0, 0, 0])", "up", {"length 0"});
  refused_fields(R"("up": [0, 1e999, 0])", "up");
  refused_fields(R"("up": [0, null, 0])", "up[1]");
  refused_fields(R"("up": "up")", "up");
  refused_fields(R"("supports": [{"normal": [0, 0, 0], "offset": 1, "kind": "desk"}])", "supports[0].normal",
                 {"not zero"});
  refused_fields(R"("supports": [{"normal": [0, 0, 1], "kind": "desk"}])", "supports[0].offset");
  refused_fields(R"("supports": [{"normal": [0, 0, 1e-5], "offset": 1e308}])", "supports[0].offset");
  refused_fields(R"("supports": [{"normal": [0, 0, 1], "offset": 1, "kind": "roof"}])", "supports[0].kind",
                 {"ceiling"});
  refused_fields(R"("supports": {})", "supports");
  refused_fields(R"("strokes": [{"label": "a", "points": [[1, 1], [8, 1]]}])", "strokes[0].points[1]",
                 {"(8, 1)", "0…7"});
  refused_fields(R"("strokes": [{"label": "a", "points": [[-1, 1]]}])", "strokes[0].points[0]");
  refused_fields(R"("strokes": [{"label": "a", "points": []}])", "strokes[0].points");
  refused_fields(R"("strokes": [{"points": [[1, 1]]}])", "strokes[0].label");
  refused_fields(R"("densities": {"a": 0})", "densities.a");
  refused_fields(R"("densities": {"a": "heavy"})", "densities.a");
}

TEST_F(Rgbd, HostileJson) {
  const std::vector<std::string> texts = {"",
                                          "{",
                                          "[]",
                                          "null",
                                          std::string(1 << 20, '['),
                                          "{\"depth\": " + std::string(200, '[') + std::string(200, ']') + "}",
                                          "{\"up\": [" + std::string(2'000'000, '1') + "], \"depth\": \"depth.png\"}",
                                          std::string("{\"depth\": \"depth.png\\u0000x\"}"),
                                          std::string("\x89PNG\0\0", 6)};
  for (const std::string& text : texts) {
    write("frame.json", text);
    EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError) << text.substr(0, 40);
  }
  std::string huge = "{\"depth\": \"depth.png\", \"up\": [0";
  for (int i = 0; i < 1'000'000; ++i) huge += ",0";
  write("frame.json", huge + "]}");
  EXPECT_THROW(read_rgbd_frame(file("frame.json")), InputError);
  fs::resize_file(file("frame.json"), 1 << 30);
  refused("", {"MiB"});
}

TEST(RealFrames, AreRead) {
  const fs::path data = fs::path(UNSEEN_SOURCE_DIR) / "../shared/data/cuboids";
  if (!fs::is_directory(data)) GTEST_SKIP() << "no data in " << data << ": real frames not checked";
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(data)) {
    if (!fs::exists(entry.path() / "frame.json")) continue;
    const RgbdFrame frame = read_rgbd_frame(entry.path());
    EXPECT_EQ(frame.depth.size(),
              static_cast<std::size_t>(frame.camera.width) * static_cast<std::size_t>(frame.camera.height));
    EXPECT_EQ(frame.color.size(), frame.depth.size());
    // What its meta.json says was measured apart from us: the share of known pixels, and the depths in metres.
    std::ifstream in(entry.path() / "meta.json");
    const nlohmann::json meta = nlohmann::json::parse(in);
    std::vector<float> known;
    std::copy_if(frame.depth.begin(), frame.depth.end(), std::back_inserter(known), [](float d) { return d > 0.0f; });
    const auto pixels = static_cast<double>(frame.depth.size());
    EXPECT_NEAR(static_cast<double>(known.size()), meta["valid"].get<double>() * pixels, 0.5) << entry.path();
    ASSERT_FALSE(known.empty());
    EXPECT_NEAR(*std::min_element(known.begin(), known.end()), meta["cloud_min"][2].get<double>(), 6e-4)
        << entry.path();
    EXPECT_NEAR(*std::max_element(known.begin(), known.end()), meta["cloud_max"][2].get<double>(), 6e-4)
        << entry.path();
    ++frames;
  }
  EXPECT_GT(frames, 0);
}

TEST(Supports, FromText) {
  const auto supports = parse_supports("0,-2,0,-3,desk; 0,0,-1,-2.5,wall;1,0,0,4", "command line");
  ASSERT_EQ(supports.size(), 3u);
  EXPECT_EQ(supports[0].plane.normal, Vec3(0, -1, 0));
  EXPECT_EQ(supports[0].plane.offset, -1.5);
  EXPECT_EQ(supports[1].kind, "wall");
  EXPECT_EQ(supports[2].kind, "ground");
  EXPECT_TRUE(parse_supports("", "command line").empty());
  for (const char* text : {"1,2,3", "0,0,0,1", "a,0,0,1", "0,0,1,inf", "0,0,1e-5,1e308", "0,0,1,1,roof", "0,0,1,1,desk,2", ";;"})
    EXPECT_THROW(parse_supports(text, "command line"), InputError) << text;
}

TEST(Jpeg, KeepsPictures) {
  std::vector<std::array<std::uint8_t, 3>> colors(64 * 32, {200, 100, 50});
  const std::string bytes = jpeg_of(colors, 64, 32);
  const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  const cv::Mat image = cv::imdecode(data, cv::IMREAD_COLOR);
  ASSERT_EQ(image.cols, 64);
  ASSERT_EQ(image.rows, 32);
  EXPECT_NEAR(image.at<cv::Vec3b>(5, 5)[2], 200, 4);
  EXPECT_NEAR(image.at<cv::Vec3b>(5, 5)[0], 50, 4);
  EXPECT_THROW(jpeg_of(colors, 64, 31), std::invalid_argument);
}

}  // namespace
}  // namespace unseen::io
