// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <opencv2/imgcodecs.hpp>

#include "io/depth_rounding.h"
#include "io/samples.h"
#include "unseen/core/random.h"

namespace unseen::io {
namespace {

void write_frame(const ScratchFolder& folder, const std::string& name, const std::string& pose,
                 const std::string& png) {
  write_file(folder / (name + ".pose.txt"), pose);
  write_file(folder / (name + ".depth.png"), png);
}

const char* const kIntrinsics = "2 0 1\n0 2 0.5\n0 0 1\n";
const char* const kPose = "0 -1 0 10\n1 0 0 20\n0 0 1 30\n0 0 0 1\n";

TEST(Depth, FramesBecomePointsInRowOrder) {
  const ScratchFolder folder;
  write_file(folder / "camera-intrinsics.txt", kIntrinsics);
  write_frame(folder, "frame-000002", kPose, png16(3, 2, 1000));
  write_frame(folder, "frame-000001", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", png16(3, 2, 2000));
  const auto source = open_points(folder.path);
  const PointCloud cloud = read_all(*source);
  ASSERT_EQ(cloud.size(), 12u);
  EXPECT_EQ(cloud.positions[0], Vec3(-1, -0.5, 2));
  EXPECT_EQ(cloud.positions[2], Vec3(1, -0.5, 2));
  EXPECT_EQ(cloud.positions[3], Vec3(-1, 0.5, 2));
  EXPECT_TRUE(cloud.positions[6].isApprox(Vec3(10.25, 19.5, 31), 1e-12));
  expect_same(read_all(*source), cloud);
  PointCloud block;
  while (source->next(block)) {
  }
  EXPECT_FALSE(source->next(block));
  ReadOptions options;
  options.depth_step = 2;
  options.frame_step = 2;
  EXPECT_EQ(read_all(*open_points(folder.path, options)).size(), 2u);
  options = {};
  options.depth_range = {0.5, 1.5};
  EXPECT_EQ(read_all(*open_points(folder.path, options)).size(), 6u);
  options.depth_range = {5, 6};
  expect_error([&] { read_all(*open_points(folder.path, options)); }, {folder.path.string(), "frames"});
}

TEST(Depth, BadFramesAreNotesAndNoisyPosesAreFine) {
  const ScratchFolder folder;
  write_file(folder / "camera-intrinsics.txt", kIntrinsics);
  write_frame(folder, "frame-1", "0.9999 0 0 0\n0 1 0.0001 0\n0 0 1 0\n0 0 0 1\n", png16(2, 2, 1000));
  write_frame(folder, "frame-2", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", png16(2, 2, 1000));
  write_frame(folder, "frame-3", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", png16(2, 2, 1000));
  write_frame(folder, "frame-4", kPose, "not an image");
  write_frame(folder, "frame-5", kPose, png8({"##"}));
  write_frame(folder, "frame-6", kPose, png16(200, 200, 1000).substr(0, 90));
  write_file(folder / "frame-7.depth.png", png16(2, 2, 1000));
  const auto source = open_points(folder.path);
  EXPECT_EQ(source->info().notes.size(), 3u);  // 2, 3 and 7
  EXPECT_EQ(read_all(*source).size(), 4u);
  EXPECT_EQ(read_all(*source).size(), 4u);
  EXPECT_EQ(source->info().notes.size(), 6u);
}

TEST(Depth, FramesOfAnotherSizeAreLeftOut) {
  const ScratchFolder folder;
  write_file(folder / "camera-intrinsics.txt", "2 0 1 0\n0 2 0.5 0\n0 0 1 0\n0 0 0 1\n");
  write_frame(folder, "frame-1", kPose, png16(3, 2, 1000));
  write_frame(folder, "frame-2", kPose, png16(6, 4, 1000));
  write_frame(folder, "frame-3", kPose, png16(3, 2, 1000));
  const auto source = open_points(folder.path);
  EXPECT_EQ(read_all(*source).size(), 12u);
  EXPECT_EQ(read_all(*source).size(), 12u);
  ASSERT_EQ(source->info().notes.size(), 1u);
  for (const char* part : {"frame-2", "6 x 4", "3 x 2"}) EXPECT_NE(source->info().notes[0].find(part), std::string::npos) << source->info().notes[0];
}

TEST(Depth, IntrinsicsOfAnotherSizeAreNoted) {
  const ScratchFolder folder;
  write_file(folder / "camera-intrinsics.txt", kIntrinsics);
  write_frame(folder, "frame-1", kPose, png16(30, 20, 1000));
  const auto source = open_points(folder.path);
  read_all(*source);
  ASSERT_EQ(source->info().notes.size(), 1u);
  EXPECT_NE(source->info().notes[0].find("principal point"), std::string::npos);
}

TEST(Depth, NothingUsableIsAnError) {
  const ScratchFolder folder;
  write_frame(folder, "frame-0", kPose, png16(2, 2, 1000));
  expect_error([&] { open_points(folder.path); }, {folder.path.string(), "camera-intrinsics.txt", "no such file"});
  std::filesystem::remove(folder / "frame-0.depth.png");
  write_file(folder / "camera-intrinsics.txt", "1 2 3");
  expect_error([&] { open_points(folder.path); }, {"camera-intrinsics.txt", "3 numbers"});
  write_file(folder / "camera-intrinsics.txt", "0 0 1\n0 2 0.5\n0 0 1\n");
  expect_error([&] { open_points(folder.path); }, {"camera-intrinsics.txt", "focal"});
  write_file(folder / "camera-intrinsics.txt", "100 5 40\n0 100 30\n0 0 1\n");
  expect_error([&] { open_points(folder.path); }, {"camera-intrinsics.txt", "skew", "5.0"});
  write_file(folder / "camera-intrinsics.txt", "100 0 0\n0 100 0\n40 30 1\n");
  expect_error([&] { open_points(folder.path); }, {"camera-intrinsics.txt", "matrix", "below its diagonal"});
  write_file(folder / "camera-intrinsics.txt", kIntrinsics);
  expect_error([&] { open_points(folder.path); }, {"frames", "frame-*.depth.png"});
  write_frame(folder, "frame-1", kPose, "no image");
  expect_error([&] { read_all(*open_points(folder.path)); }, {"frames", "none usable", "frame-1.depth.png"});
  ReadOptions options;
  options.depth_range = {2, 1};
  expect_error([&] { open_points(folder.path, options); }, {"depth_range"});
  options = {};
  options.depth_step = 0;
  expect_error([&] { open_points(folder.path, options); }, {"depth_step"});
}

/// Rounding that is read from a picture of depths (m, evenly from 1 to 3) as a sensor tells them.
template <class Tell>
double rounding_read(const Tell& tell) {
  constexpr int kPixels = 200000;
  DepthImage image{kPixels, 1, {}};
  for (int i = 0; i < kPixels; ++i) image.millimetres.push_back(static_cast<std::uint16_t>(std::lround(1e3 * tell(1.0 + 2.0 * i / kPixels))));
  DepthValues values;
  values.add(image, 0.5, 3.5);
  return values.rounding();
}

TEST(Depth, RoundingOfTheSensorIsRead) {
  Random random(1);
  const auto disparity = [](double z) { return 315.0 / std::round(315.0 / z); };  // eighths of a pixel
  constexpr double typical = 2.0;
  EXPECT_NEAR(rounding_read(disparity), typical * typical / 315.0, 0.002);
  EXPECT_NEAR(rounding_read([&](double z) { return random.uniform() < 0.03 ? z : disparity(z); }), typical * typical / 315.0, 0.002);  // pixels on edges
  EXPECT_NEAR(rounding_read([](double z) { return std::round(100.0 * z) / 100.0; }), 0.01, 1e-9);
  EXPECT_NEAR(rounding_read([](double z) { return z; }), 0.001, 1e-9);
  EXPECT_NEAR(rounding_read([&](double z) { return z + 0.0015 * z * z * random.normal(); }), 0.001, 1e-9);
  EXPECT_NEAR(rounding_read([](double z) { return z < 2.0 ? std::round(100.0 * z) / 100.0 : 4.0; }), 0.01, 1e-9);  // some are too far
  EXPECT_EQ(rounding_read([](double z) { return z < 2.0 ? 1.4 : 2.7; }), 0.0);                        // walls that face the camera
  EXPECT_LT(rounding_read([](double z) { return z < 1.5 ? z : std::round(2.0 * z) / 2.0; }), 0.002);  // some of them
}

TEST(Depth, RoundingIsKnownAfterAPass) {
  const ScratchFolder folder;
  write_file(folder / "camera-intrinsics.txt", "50 0 32\n0 50 24\n0 0 1\n");
  cv::Mat depth(48, 64, CV_16U);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(1000 + 20 * v);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", depth, png);
  write_frame(folder, "frame-1", kPose, std::string(png.begin(), png.end()));
  const auto source = open_points(folder.path);
  EXPECT_EQ(source->info().rounding, 0.0);
  read_all(*source);
  EXPECT_NEAR(source->info().rounding, 0.02, 1e-9);
  read_all(*source);
  EXPECT_NEAR(source->info().rounding, 0.02, 1e-9);
}

TEST(Image, DarkPixelsBecomePoints) {
  const auto source = open_points_in_memory(png8({"#  ", "  #"}), "a.png");
  EXPECT_TRUE(source->info().two_dimensional);
  EXPECT_EQ(read_all(*source).positions, (std::vector<Vec3>{Vec3(0, 1, 0), Vec3(2, 0, 0)}));
}

TEST(Image, TransparentIsWhiteAndJpegIsRead) {
  cv::Mat image(2, 2, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  image.at<cv::Vec4b>(0, 1) = {0, 0, 0, 255};
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  EXPECT_EQ(read({bytes.begin(), bytes.end()}, "a.png").positions, (std::vector<Vec3>{Vec3(1, 1, 0)}));
  cv::imencode(".jpg", cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 0)), bytes);
  EXPECT_EQ(read({bytes.begin(), bytes.end()}, "a.jpg").size(), 64u);
}

TEST(Image, SaysThatThinLinesMayHaveGaps) {
  const auto notes_of = [](int least, int most) {  // of a line whose darkness runs from one to the other along it
    cv::Mat image(9, 101, CV_8U, cv::Scalar(255));
    for (int x = 0; x < image.cols; ++x) image.at<std::uint8_t>(4, x) = static_cast<std::uint8_t>(least + (most - least) * x / 100);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes);
    return open_points_in_memory({bytes.begin(), bytes.end()}, "a.png")->info().notes;
  };
  EXPECT_EQ(notes_of(0, 130).size(), 1u);  // a fifth is grey
  ASSERT_EQ(notes_of(0, 200).size(), 2u);  // half as many grey pixels as dark ones
  EXPECT_NE(notes_of(0, 200)[1].find("--threshold 0.6"), std::string::npos);
  expect_read_error(png8({"   "}), "bad.png", {"--threshold"});
}

std::string encoded(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A sheet with a frame drawn on it.
cv::Mat sheet() {
  cv::Mat image(300, 400, CV_8U, cv::Scalar(255));
  image(cv::Rect(80, 60, 240, 180)).setTo(0);
  image(cv::Rect(84, 64, 232, 172)).setTo(255);
  return image;
}

TEST(Image, LightLinesOnADarkGroundAreTheDrawing) {
  const PointCloud drawn = read(encoded(sheet()), "a.png");
  EXPECT_EQ(drawn.size(), 240u * 180u - 232u * 172u);
  const auto source = open_points_in_memory(encoded(255 - sheet()), "a.png");
  expect_same(read_all(*source), drawn);
  EXPECT_NE(source->info().notes[1].find("light lines"), std::string::npos);
}

TEST(Image, BroadDarkBordersAreNoDrawing) {
  cv::Mat scanned = sheet();
  scanned.rowRange(0, 20).setTo(0);
  scanned.colRange(370, 400).setTo(20);
  const auto source = open_points_in_memory(encoded(scanned), "a.png");
  expect_same(read_all(*source), read(encoded(sheet()), "a.png"));
  EXPECT_NE(source->info().notes[1].find("border left out"), std::string::npos);
  cv::Mat walls(300, 400, CV_8U, cv::Scalar(255));  // that run off the picture stay
  walls.rowRange(100, 110).setTo(0);
  EXPECT_EQ(read(encoded(walls), "a.png").size(), 4000u);
}

TEST(Image, BroadAreasAreOutlined) {
  cv::Mat filled = sheet();
  filled(cv::Rect(100, 80, 24, 140)).setTo(0);  // a wall; the frame's lines are 4 pixels wide
  const auto source = open_points_in_memory(encoded(filled), "a.png");
  const PointCloud cloud = read_all(*source);
  const std::size_t frame = 240u * 180u - 232u * 172u;
  EXPECT_EQ(cloud.size(), frame + 24u * 140u - 22u * 138u);
  ASSERT_EQ(source->info().notes.size(), 2u);
  EXPECT_NE(source->info().notes[1].find("broader than 12 pixels"), std::string::npos);
  cv::Mat turned(300, 300, CV_8U, cv::Scalar(255));
  const auto across = [](double x, double y) { return std::abs(x - 2.0 * y) / std::sqrt(5.0); };
  for (int y = 0; y < turned.rows; ++y)
    for (int x = 0; x < turned.cols; ++x)
      if (across(x, y) < 12.0) turned.at<std::uint8_t>(y, x) = 0;
  for (const Vec3& p : read(encoded(turned), "a.png").positions) EXPECT_NEAR(across(p.x(), 299.0 - p.y()), 11.0, 1.0);
}

TEST(Image, LinesAlongTheBorderAreNoAreas) {
  cv::Mat image(300, 400, CV_8U, cv::Scalar(255));
  image.rowRange(0, 5).setTo(0);
  image.colRange(0, 5).setTo(0);
  const auto source = open_points_in_memory(encoded(image), "a.png");
  EXPECT_EQ(read_all(*source).size(), 400u * 5u + 295u * 5u);
  EXPECT_EQ(source->info().notes.size(), 1u);
  image.setTo(255);
  image(cv::Rect(0, 100, 200, 24)).setTo(0);  // a filled wall that leaves the picture has no outline there
  for (const Vec3& p : read(encoded(image), "a.png").positions) EXPECT_TRUE(p.x() > 197.0 || std::abs(p.y() - 187.5) > 11.0) << p.transpose();
}

TEST(Image, ADepthImageIsSaidToBeNone) {
  for (const std::uint16_t no_data : {0, 65535}) {
    cv::Mat depth(60, 80, CV_16U, cv::Scalar(1500));
    depth(cv::Rect(10, 10, 20, 20)).setTo(no_data);
    const auto notes = open_points_in_memory(encoded(depth), "a.png")->info().notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& n) { return n.find("depth image") != std::string::npos; })) << no_data;
  }
}

TEST(Image, PaperThatIsGreyIsPaper) {
  for (const int paper : {85, 110, 140, 180})
    for (const int ink : {0, 25}) {
      cv::Mat photo(300, 400, CV_8U);
      cv::theRNG().state = 1;
      cv::randn(photo, paper, 8);
      photo(cv::Rect(80, 60, 240, 4)).setTo(ink);
      const auto source = open_points_in_memory(encoded(photo), "a.png");
      EXPECT_EQ(read_all(*source).size(), 960u) << paper << " " << ink;
      EXPECT_EQ(source->info().notes.size(), 1u) << paper << " " << source->info().notes.back();
    }
}

TEST(Image, FaultsNameFileAndField) {
  expect_read_error(png8({"   "}), "bad.png", {"pixels", "dark"});
  expect_read_error(png8({"# #"}).substr(0, 20), "bad.png", {"image", "header"});
  expect_read_error(png8(std::vector<std::string>(50, "# ## #")).substr(0, 60), "bad.png",
                    {"image", "truncated"});
  std::string huge = png8({"#"});
  huge.replace(16, 8, std::string("\x00\x00\xff\xff\x00\x00\xff\xff", 8));
  expect_read_error(huge, "bad.png", {"image", "65535 x 65535"});
  expect_read_error("\xff\xd8\xff\xe0 broken", "bad.jpg", {"image"});
}

}  // namespace
}  // namespace unseen::io
