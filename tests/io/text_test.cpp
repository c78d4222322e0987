// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <array>
#include <cmath>

#include "io/samples.h"

namespace unseen::io {
namespace {

std::string notes_of(const std::string& bytes, const std::string& name) {
  std::string all;
  for (const std::string& note : open_points_in_memory(bytes, name)->info().notes) all += note + "\n";
  return all;
}

TEST(Text, PositionsWithAnySeparator) {
  for (const char* s :
       {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6\n", "1;2;3\r\n4;5;6\r\n", "1\t2\t3\n\n4\t5\t6", "  1   2 3 \n4 5 6",
        "# remark\n1, 2, 3\n4, 5, 6", "1,0;2,0;3\n4;5,0;6\n", "1;2;3\n4,0;5,0;6,0\n",
        "1,0 2,0 3,0\n4,0 5,0 6,0\n", "X\tY\tZ\n1,0\t2,0\t3\n4\t5,0\t6\n", "1 2 3\n4,0  5,0 6\n",
        "\xef\xbb\xbf"
        "1 2 3\n4 5 6\n",
        "x,y,z\n1,2,3\n4,5,6\n", "2\n1 2 3\n4 5 6\n", "\"1\",\"2\",\"3\"\n\"4\",\"5\",\"6\"\n",
        "+1 2 3\n4 5 6\n"}) {
    const PointCloud cloud = read(s, "a.xyz");
    ASSERT_EQ(cloud.size(), 2u) << s;
    EXPECT_EQ(cloud.positions[0], Vec3(1, 2, 3)) << s;
    EXPECT_EQ(cloud.positions[1], Vec3(4, 5, 6)) << s;
    EXPECT_TRUE(cloud.normals.empty() && cloud.colors.empty());
  }
}

TEST(Text, SixColumnsAreNormalsOrColours) {
  EXPECT_EQ(read("1 2 3 0 0 1\n1 2 3 0 0 0\n1 2 3 0.6 0.8 0\n", "a.xyz").normals[2], Vec3f(0.6f, 0.8f, 0));
  EXPECT_EQ(read("1 2 3 0 0 1\n1 2 3 0 200 1\n", "a.xyz").colors[1],
            (std::array<std::uint8_t, 3>{0, 200, 1}));
  const PointCloud other = read("1 2 3 0.1 0.2 900\n", "a.xyz");
  EXPECT_TRUE(other.normals.empty() && other.colors.empty());
  EXPECT_NE(notes_of("1 2 3 0.1 0.2 900\n", "a.xyz").find("ignored"), std::string::npos);
}

TEST(Text, WiderRows) {
  const PointCloud pts = read("1\n1 2 3 -1500 10 20 30\n", "a.pts");
  EXPECT_EQ(pts.colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
  const PointCloud nine = read("1 2 3 10 20 30 0 1 0\n", "a.txt");
  EXPECT_EQ(nine.colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_EQ(nine.normals[0], Vec3f(0, 1, 0));
  EXPECT_NE(notes_of("1 2 3 10 20 30 0 1 0\n", "a.txt").find("x y z red green blue nx ny nz"),
            std::string::npos);
}

TEST(Text, PointNumbersAreNoCoordinate) {
  const auto source = open_points_in_memory("17 5 2 0\n18 6 3 1\n19 5 4 0.5\n", "a.txt");
  EXPECT_EQ(read_all(*source).positions, (std::vector<Vec3>{Vec3(5, 2, 0), Vec3(6, 3, 1), Vec3(5, 4, 0.5)}));
  EXPECT_NE(source->info().notes[0].find("counts the rows"), std::string::npos);
  const PointCloud colored = read("1 5 2 0 255 0 9\n2 6 3 1 0 0 9\n3 5 4 0.5 255 0 9\n", "a.csv");
  EXPECT_EQ(colored.colors[0], (std::array<std::uint8_t, 3>{255, 0, 9}));
  EXPECT_EQ(read("0 5 2 7\n1 5 3 7\n2 5 4 7\n", "a.txt").positions[2], Vec3(2, 5, 4));  // the first row of a grid
  EXPECT_EQ(read("0 5 2\n1 6 3\n2 5 4\n", "a.txt").positions[2], Vec3(2, 5, 4));
  EXPECT_EQ(read("0 5 2 7\n1 6 3 7\n3 5 4 7\n", "a.txt").positions[2], Vec3(3, 5, 4));
}

TEST(Text, DegreesAreNoMetres) {
  expect_read_error("Latitude,Longitude,height\n48.1,11.5,520\n48.2,11.6,521\n", "bad.csv", {"columns", "degrees", "UTM"});
  EXPECT_EQ(read("x y lat\n48.1 11.5 520\n48.2 11.6 521\n", "a.txt").size(), 2u);
}

TEST(Text, ANamedHeaderDecides) {
  const PointCloud cloud = read("label,z,y,x,r,g,b,remark\n4,3,2,1,0.5,0,1,wall\n5,6,5,4,0,0,0,\n", "a.csv");
  EXPECT_EQ(cloud.positions[1], Vec3(4, 5, 6));
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{4, 5}));
  EXPECT_EQ(cloud.colors[0], (std::array<std::uint8_t, 3>{128, 0, 255}));
  EXPECT_EQ(read("id,Easting,Northing,height\n7,1,2,3\n8,4,5,6\n", "a.csv").positions[1], Vec3(4, 5, 6));
  EXPECT_EQ(read("//X Y Z Nx Ny Nz\n1 2 3 0 0 2\n", "a.asc").normals[0], Vec3f(0, 0, 2));
}

TEST(Text, NamesOfSurveyorsAndOtherProgramsCount) {
  for (const char* header : {"N,E,Z", "Northing (m),Easting [m],Elev", "N,E,H", "Points:1,Points:0,Points:2", "pos_y,pos_x,pos_z", "Y Coordinate,X Coordinate,Z Coordinate",
                             "cartesianY,cartesianX,cartesianZ", "y_coord,x_coord,z_coord", "Pos.Y,Pos.X,Pos.Z", "y,x,RL", "Hochwert,Rechtswert,H\u00f6he"})
    EXPECT_EQ(read(std::string(header) + "\n2,1,3\n5,4,6\n", "a.csv").positions[1], Vec3(4, 5, 6)) << header;
  EXPECT_EQ(read("Intensity,colorRed,colorGreen,colorBlue,X(m),Y(m),Z(m)\n9,10,20,30,1,2,3\n", "a.csv").colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_NE(notes_of("y,x,RL\n2,1,3\n", "a.csv").find("\"RL\" read as z"), std::string::npos);
  EXPECT_NE(notes_of("a,b,c\n2,1,3\n", "a.csv").find("names no x and y"), std::string::npos);
  for (const char* drawing : {"x,y,intensity\n1,2,3\n", "x,y,u,v\n1,2,3,4\n", "x,y,d\n1,2,\n"})
    EXPECT_TRUE(open_points_in_memory(drawing, "a.csv")->info().two_dimensional) << drawing;
}

TEST(Text, TitlesUnitsAndNumberedColumnsAreNoPoints) {
  for (const char* s : {"Some scanner, version 3\nx,y,z\n1,2,3\n", "x,y,z\nm,m,m\n1,2,3\n", "% exported\n% x y z\n1 2 3\n", ",0,1,2\n0,1,2,3\n1,4,5,6\n2,1,1,1\n"})
    EXPECT_EQ(read(s, "a.csv").positions[0], Vec3(1, 2, 3)) << s;
  expect_read_error("one\ntwo\nthree\nfour\nfive\nsix\nseven\n1 2 3\n", "bad.txt", {"line 2", "two"});
}

TEST(Text, PlacesInAGridAndColoursAsSharesAreSeen) {
  EXPECT_EQ(read("0 0 1.5 2.5 3.5 9 8 7\n0 1 1.5 2.5 3.75 9 8 7\n1 0 2.5 2.5 3.5 9 8 7\n", "a.xyz").positions[1], Vec3(1.5, 2.5, 3.75));
  EXPECT_EQ(read("0 0 1.5 0 0 1\n1 0 1.5 0 0.6 0.8\n1 1 1.5 0 0.8 0.6\n", "a.xyz").positions[2], Vec3(1, 1, 1.5));  // a grid on the ground, with normals
  EXPECT_EQ(read("1 2 3 0.2 0.4 1\n4 5 6 0 0 0\n", "a.xyzrgb").colors[0], (std::array<std::uint8_t, 3>{51, 102, 255}));
}

TEST(Text, TwoColumnsAreADrawing) {
  const auto source = open_points_in_memory("1 2\n3 4\n", "a.txt");
  EXPECT_TRUE(source->info().two_dimensional);
  EXPECT_EQ(read_all(*source).positions[1], Vec3(3, 4, 0));
}

TEST(Text, PwnPointsThenNormals) {
  const PointCloud cloud = read("2\n1 2 3\n4 5 6\n0 0 1\n0 1 0\n", "a.pwn");
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.normals[1], Vec3f(0, 1, 0));
}

TEST(Text, PtsWithSeveralScans) {
  const PointCloud cloud = read("2\n1 2 3 0\n4 5 6 0\n1\n7 8 9 0\n", "a.pts");
  ASSERT_EQ(cloud.size(), 3u);
  EXPECT_EQ(cloud.positions[2], Vec3(7, 8, 9));
}

TEST(Text, PrecisionMissingAndExtremeNumbers) {
  const PointCloud cloud = read("500000.123456789 1e999 1e-999\nnan inf -inf\n", "a.xyz");
  EXPECT_EQ(cloud.positions[0].x(), 500000.123456789);
  EXPECT_TRUE(std::isinf(cloud.positions[0].y()));
  EXPECT_EQ(cloud.positions[0].z(), 0.0);
  EXPECT_TRUE(std::isnan(cloud.positions[1].x()));
  EXPECT_TRUE(std::isnan(read("1,2,3\n1,,3\n", "a.csv").positions[1].y()));
}

TEST(Text, FaultsNameFileAndLine) {
  const auto bad = [](const std::string& s, const std::vector<std::string>& parts) {
    expect_read_error(s, "bad.xyz", parts);
  };
  bad("\n\n", {"no row"});
  bad("x y z\n", {"no row"});
  bad("hello world\nfoo bar\n", {"line 2", "foo bar"});
  bad("-3\n1 2 3\n", {"line 1", "-3", "count"});
  bad("0\n", {"count of points", "0"});
  bad("1000000000\n1 2 3\n", {"count of points", "1 line", "1000000000"});
  bad("3\n1.25 2.25 3.25\n4.25 5.25 6.25\n", {"count of points", "2 points", "the 3"});
  bad("1\n1 2 3\n4 5 6\n7 8 9\n", {"line 3", "4 5 6"});
  bad("1 2 3\n4 5\n", {"line 2", "4 5", "3 numbers"});
  bad("1 2 3\n4 5 6 7\n", {"line 2"});
  bad("1 2 3\n4 five 6\n", {"line 2", "five"});
  bad("1,2,3\n4,5\n", {"line 2", "4,5"});
  bad("a,b,c\n1\n", {"count of points", "0 lines"});
  bad(std::string("\xff\xfe"
                  "1\0 \0",
                  6),
      {"UTF-16"});
  bad(std::string("\1\2\3\4\0\0\5", 7), {"line 1"});
  bad(std::string(3000000, '1'), {"line 1"});
  expect_read_error(std::string("\1\2\3\4\0\0\5", 7), "noending", {"content", "no format known"});
}

TEST(Sniff, ForeignFormatsAreNamedWithTheWayOut) {
  for (const auto& [bytes, name, way_out] : std::vector<std::array<std::string, 3>>{{"%PDF-1.4\n1 0 obj\n", "a PDF", "PNG"},
                                                                                   {std::string("II*\0\x08\0\0\0", 8), "a TIFF image", "PNG"},
                                                                                   {std::string("BM\x36\0\0\0", 6), "a BMP image", "PNG"},
                                                                                   {"RIFF1234WEBPVP8 ", "a WebP image", "PNG"},
                                                                                   {"# vtk DataFile Version 3.0\npoints\nASCII\n", "a VTK file", "PLY"},
                                                                                   {"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", "a DXF drawing", "OBJ"},
                                                                                   {"<?xml version=\"1.0\"?><COLLADA/>", "an XML file", "OBJ"},
                                                                                   {"{\"asset\": {}}", "a JSON file", "OBJ"},
                                                                                   {"<!doctype html>\n<html>", "a web page", "the file itself"},
                                                                                   {"ISO-10303-21;\nHEADER;\n", "a STEP or IFC model", "STL"},
                                                                                   {std::string("PK\3\4\0\0", 6), "a ZIP archive", "unpacked"}})
    for (const char* file : {"bad", "bad.txt"}) expect_read_error(bytes, file, {"content", name, way_out});
}

}  // namespace
}  // namespace unseen::io
