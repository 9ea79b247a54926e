// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cloud {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string pcd(const std::string& fields, const std::string& types, const std::string& sizes,
                const std::string& data, const std::string& size = "WIDTH 2\nHEIGHT 1\n") {
  return "FIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types + "\n" + size +
         "POINTS 2\nDATA ascii\n" + data;
}

void expect_points(const Cloud& cloud) {
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0].x_m, 3);
  EXPECT_EQ(cloud.points[0].y_m, -1);
  EXPECT_EQ(cloud.points[0].z_m, 0.5F);
  EXPECT_FLOAT_EQ(cloud.points[0].remission, 51 / 255.0F);
  EXPECT_FLOAT_EQ(cloud.points[1].remission, 1);
}

TEST(CloudFile, IsReadByTheEndingOfItsName) {
  const test::ScratchFolder folder;
  Cloud cloud;
  const std::array kitti{3.0F, -1.0F, 0.5F, 0.2F, 1.0F, 1.0F, 1.0F, 1.0F};
  ASSERT_TRUE(read_cloud(folder.write_records("a.bin", kitti), cloud));
  expect_points(cloud);
  EXPECT_THAT(cloud.laser, IsEmpty());

  const std::array nuscenes{1.0F, 3.0F, 0.5F, 51.0F, 7.0F, 1.0F, 1.0F, 1.0F, 255.0F, 31.0F};
  ASSERT_TRUE(read_cloud(folder.write_records("a.pcd.bin", nuscenes), cloud));
  expect_points(cloud);
  EXPECT_THAT(cloud.laser, ElementsAre(7, 31));

  const std::string data = "3 -1 0.5 51 7\n1 1 1 255 31\n";
  ASSERT_TRUE(read_cloud(
      folder.write("a.pcd", pcd("x y z intensity ring", "F F F F U", "4 4 4 4 2", data)), cloud));
  expect_points(cloud);
  EXPECT_THAT(cloud.laser, ElementsAre(7, 31));

  ASSERT_TRUE(
      read_cloud(folder.write("a.ply",
                              "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty "
                              "float y\nproperty float z\nproperty float intensity\nproperty uchar "
                              "channel\nend_header\n" +
                                  data),
                 cloud));
  expect_points(cloud);
  EXPECT_THAT(cloud.laser, ElementsAre(7, 31));

  ASSERT_TRUE(read_cloud(folder.write_records("A.PCD.BIN", nuscenes), cloud));
  EXPECT_THAT(cloud.laser, ElementsAre(7, 31));
  ASSERT_TRUE(read_cloud(folder.write_records("A.BIN", kitti), cloud));
  EXPECT_TRUE(is_cloud_file("A.PCD") && is_cloud_file("A.PLY") && is_cloud_file("A.Bin"));
  EXPECT_EQ(read_cloud(folder.write("a.txt", data), cloud).error().code, ErrorCode::kUnsupported);
}

TEST(CloudFile, TellsTheLaserByAnyOfTheNamesInUseAndKeepsTheOrganisation) {
  const test::ScratchFolder folder;
  Cloud cloud;
  for (const std::string name :
       {"ring", "channel", "laser", "row", "laser_id", "line", "Ring", "scalar_ring",
        "scalar_Laser_ID", "laserId", "beam_index", "CHANNEL_ID"}) {
    const auto file =
        folder.write("a.pcd", pcd("time x " + name + " y z", "F F U F F", "8 4 1 4 4",
                                  "0 3 7 -1 0.5\n0.1 nan 31 nan nan\n", "WIDTH 1\nHEIGHT 2\n"));
    ASSERT_TRUE(read_cloud(file, cloud)) << name;
    EXPECT_THAT(cloud.laser, ElementsAre(7, 31)) << name;
    EXPECT_EQ(cloud.rows, 2U);
    EXPECT_TRUE(std::isnan(cloud.points[1].x_m));
  }
}

TEST(CloudFile, ThatIsNoCloudIsRefusedByName) {
  const test::ScratchFolder folder;
  const auto error_of = [&](const std::string& content) {
    Cloud cloud;
    const Status read = read_cloud(folder.write("a.pcd", content), cloud);
    if (read) return std::string("none");
    EXPECT_THAT(read.error().message, HasSubstr("a.pcd: "));
    return read.error().message;
  };
  EXPECT_THAT(error_of(pcd("x y ring", "F F U", "4 4 1", "1 1 1\n1 1 1\n")),
              HasSubstr("expected the fields x, y and z; it has: x y ring"));
  EXPECT_THAT(error_of(pcd("x y z", "F F F", "4 4 4", "1 1 1\n1 1 1\n", "WIDTH 3\nHEIGHT 1\n")),
              HasSubstr("2 POINTS, but WIDTH 3 and HEIGHT 1"));
}

TEST(CloudFile, DoesNotAskForTheLaserOfPointsThatAreNoReturns) {
  const test::ScratchFolder folder;
  Cloud cloud;
  for (const char* nothing : {"nan nan nan nan", "0 0 0 -1", "nan 1 1 65535", "99999 0 0 0.5"}) {
    const auto file = folder.write(
        "a.pcd", pcd("x y z ring", "F F F F", "4 4 4 4", std::string(nothing) + "\n1 1 1 7\n"));
    ASSERT_TRUE(read_cloud(file, cloud));
    EXPECT_THAT(cloud.laser, ElementsAre(testing::_, 7)) << nothing;
  }
  const std::array nuscenes{0.0F, 0.0F, 0.0F, 0.0F, NAN, 1.0F, 1.0F, 1.0F, 255.0F, 31.0F};
  ASSERT_TRUE(read_cloud(folder.write_records("a.pcd.bin", nuscenes), cloud));
  EXPECT_THAT(cloud.laser, ElementsAre(0, 31));
}

TEST(CloudFile, TakesNoFieldForTheLasersNumberThatHasOtherNumbersAndSaysSo) {
  const test::ScratchFolder folder;
  Cloud cloud;
  const auto read = [&](const std::string& fields, const std::string& data) {
    const std::size_t count = static_cast<std::size_t>(std::ranges::count(fields, ' ')) + 1;
    std::string types = "F", sizes = "4";
    for (std::size_t i = 1; i < count; ++i) {
      types += " F";
      sizes += " 4";
    }
    EXPECT_TRUE(read_cloud(folder.write("a.pcd", pcd(fields, types, sizes, data)), cloud));
  };
  for (const std::string bad : {"1.5", "256", "58792", "-1", "nan"}) {
    read("x y z ring", "1 1 1 " + bad + "\n1 1 1 1\n");
    EXPECT_THAT(cloud.laser, IsEmpty()) << bad;
    EXPECT_THAT(cloud.laser_note, HasSubstr("ring of point 0 is " + bad + ", expected a whole"));
    read("x y z ring channel", "1 1 1 " + bad + " 3\n1 1 1 1 4\n");
    EXPECT_THAT(cloud.laser, ElementsAre(3, 4)) << "another field has it";
    EXPECT_THAT(cloud.laser_note, HasSubstr("field "));
  }
  read("x y z ring channel", "1 1 1 0 3\n1 1 1 0 4\n");
  EXPECT_THAT(cloud.laser, ElementsAre(3, 4)) << "a field that is all 0 is one nobody filled";
  read("x y z ring", "1 1 1 0\n1 1 1 0\n");
  EXPECT_THAT(cloud.laser, ElementsAre(0, 0));
  read("x y z time", "1 1 1 0\n1 1 1 0\n");
  EXPECT_THAT(cloud.laser_note, HasSubstr("its fields are x y z time"));
}

TEST(CloudFile, KeepsWhatIntensitiesMeanWhateverTheirScale) {
  const test::ScratchFolder folder;
  Cloud cloud;
  const std::array kitti{1.0F, 1.0F, 1.0F, 51.0F, 1.0F, 1.0F, 1.0F, 255.0F};
  ASSERT_TRUE(read_cloud(folder.write_records("a.bin", kitti), cloud));
  EXPECT_FLOAT_EQ(cloud.points[0].remission, 0.2F);
  EXPECT_FLOAT_EQ(cloud.points[1].remission, 1);
  const auto of = [&](const std::string& first, const std::string& second) {
    const auto file = folder.write("a.pcd", pcd("x y z scalar_Intensity", "F F F F", "4 4 4 4",
                                                "1 1 1 " + first + "\n1 1 1 " + second + "\n"));
    EXPECT_TRUE(read_cloud(file, cloud));
    return cloud.points[0].remission;
  };
  EXPECT_FLOAT_EQ(of("0.2", "1"), 0.2F);
  EXPECT_FLOAT_EQ(of("51", "255"), 0.2F);
  EXPECT_FLOAT_EQ(of("13107", "65535"), 0.2F);
  EXPECT_FLOAT_EQ(of("13107", "300"), 0.2F);
  EXPECT_FLOAT_EQ(of("51", "nan"), 0.2F);
  EXPECT_FLOAT_EQ(of("0.2", "inf"), 0.2F);
}

TEST(CloudFile, OfAnotherNumberOfFloatsAPointSaysHowToNameIt) {
  const test::ScratchFolder folder;
  Cloud cloud;
  const auto error_of = [&](const std::string& name, const std::vector<float>& floats) {
    const Status read = read_cloud(folder.write_records(name, floats), cloud);
    return read ? std::string("none") : read.error().message;
  };
  std::vector<float> five;
  for (int i = 0; i < 16; ++i) {
    five.insert(five.end(),
                {3.3F, 1.5F + static_cast<float>(i), -0.7F, 20.0F, static_cast<float>(i)});
  }
  EXPECT_THAT(error_of("a.bin", five), HasSubstr("5 floats a point (x y z intensity ring)? Then "
                                                 "name it .pcd.bin"));
  EXPECT_EQ(error_of("a.pcd.bin", five), "none");
  five.resize(75);
  EXPECT_THAT(error_of("a.bin", five),
              testing::AllOf(HasSubstr("truncated"), HasSubstr("5 floats")));
  five.resize(66);
  EXPECT_THAT(error_of("a.bin", five), HasSubstr("3 or 6 floats a point? Expected are 4"));
  five.resize(73);
  EXPECT_THAT(error_of("a.bin", five), testing::Not(HasSubstr("5 floats")));

  const std::vector<float> four(80, 1.5F);
  EXPECT_THAT(error_of("a.pcd.bin", four),
              testing::AllOf(HasSubstr("ring of point 0 is 1.5"), HasSubstr("Then name it .bin")));
  EXPECT_THAT(error_of("a.pcd.bin", std::vector<float>(4, 1.5F)), HasSubstr("Then name it .bin"));
  EXPECT_EQ(error_of("a.bin", std::vector<float>(80, 0.0F)), "none") << "null points";
}

TEST(CloudFile, MayBeEmptyOrWithoutAPlaceWhereTheSensorIsCovered) {
  const test::ScratchFolder folder;
  Cloud cloud;
  for (const char* name : {"a.bin", "a.pcd.bin"}) {
    ASSERT_TRUE(read_cloud(folder.write(name, ""), cloud)) << name;
    EXPECT_THAT(cloud.points, IsEmpty());
  }
  ASSERT_TRUE(read_cloud(folder.write("a.pcd",
                                      "FIELDS x y z ring intensity\nSIZE 4 4 4 1 4\nTYPE F F "
                                      "F U F\nPOINTS 0\nDATA ascii\n"),
                         cloud));
  EXPECT_THAT(cloud.points, IsEmpty());
  ASSERT_TRUE(
      read_cloud(folder.write("a.pcd", pcd("x y z", "F F F", "4 4 4", "nan 1 1\n0 0 0\n")), cloud));
  EXPECT_EQ(cloud.points.size(), 2U);
  EXPECT_FALSE(has_places(cloud.points));
}

TEST(CloudFile, IsMovedToItsViewpointWhereThatIsAskedFor) {
  const test::ScratchFolder folder;
  Cloud cloud;
  // Far from the origin, and turned by a quarter to the left.
  const auto file =
      folder.write("a.pcd",
                   "VIEWPOINT 400000 5000000 30 0.7071067811865476 0 0 "
                   "0.7071067811865476\n" +
                       pcd("x y z ring", "F F F U", "8 8 8 1", "400001 5000002 29.5 7\n0 0 0 0\n"));
  ASSERT_TRUE(read_cloud(file, cloud));
  EXPECT_TRUE(cloud.has_viewpoint);
  EXPECT_EQ(cloud.points[0].x_m, 400001);
  ASSERT_TRUE(read_cloud(file, cloud, SensorPlace::kViewpoint));
  EXPECT_NEAR(cloud.points[0].x_m, 2, 1e-6);
  EXPECT_NEAR(cloud.points[0].y_m, -1, 1e-6);
  EXPECT_NEAR(cloud.points[0].z_m, -0.5, 1e-6);
  EXPECT_EQ(cloud.points[1].x_m, 0) << "no return stays none";
  const auto beside =
      folder.write("b.pcd", "VIEWPOINT 1 2 3 1 0 0 0\n" +
                                pcd("x y z ring", "F F F U", "8 8 8 1", "0 5 0 7\n7 0 0 7\n"));
  ASSERT_TRUE(read_cloud(beside, cloud, SensorPlace::kViewpoint));
  EXPECT_EQ(cloud.points[0].y_m, 3) << "a place on an axis is one";
  EXPECT_EQ(cloud.points[1].x_m, 6);
}

/// What check_reach() says of the points of a ring of 10 to 30 metres, moved so.
template <class Move>
std::string reach_of(Move&& move) {
  std::vector<scan::ScanPoint> points(7);  // some are null
  for (int i = 0; i < 360; ++i) {
    const double azimuth_rad = i * M_PI / 180, distance_m = 20 + 10 * std::sin(7 * azimuth_rad);
    std::array<double, 3> at{distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad),
                             -1.7};
    move(at);
    points.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]), 0});
  }
  const Status near = check_reach(points);
  return near ? "near" : near.error().message;
}

TEST(CloudReach, NamesTheUnitOrTheFrameThatIsWrong) {
  const auto times = [](double factor) {
    return reach_of([=](std::array<double, 3>& at) {
      for (double& figure : at) figure *= factor;
    });
  };
  EXPECT_EQ(times(1), "near");
  EXPECT_THAT(times(1000),
              HasSubstr("360 of 360 points are farther than 150 m from the origin: are "
                        "these millimetres?"));
  EXPECT_THAT(times(100), HasSubstr("are these centimetres?"));
  const auto moved_by = [](double x_m, double y_m) {
    return reach_of([=](std::array<double, 3>& at) {
      at[0] += x_m;
      at[1] += y_m;
    });
  };
  EXPECT_EQ(moved_by(100, 0), "near");
  EXPECT_THAT(moved_by(500, 0), HasSubstr("are these coordinates of a map?"));
  EXPECT_THAT(moved_by(4e5, 5e6), HasSubstr("are these coordinates of a map?"));
  EXPECT_THAT(reach_of([](std::array<double, 3>& at) {
                for (double& figure : at) {  // as if read in the other byte order
                  auto bytes = std::bit_cast<std::array<char, 4>>(static_cast<float>(figure));
                  std::ranges::reverse(bytes);
                  figure = double{std::bit_cast<float>(bytes)};
                }
              }),
              HasSubstr("another layout, or big-endian?"));
}

TEST(CloudReach, AsksNothingOfAFewStrayPoints) {
  const std::vector<scan::ScanPoint> points(10, {400, 0, 0, 0});
  EXPECT_TRUE(check_reach(points));
  EXPECT_TRUE(check_reach({}));
}

}  // namespace
}  // namespace terracut::cloud
