// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_file.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/firmware_io/scan/scratch_folder.hpp"

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
  const scan::ScratchFolder folder;
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
  const scan::ScratchFolder folder;
  Cloud cloud;
  for (const std::string name : {"ring", "channel", "laser", "row"}) {
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
  const scan::ScratchFolder folder;
  const auto error_of = [&](const std::string& content) {
    Cloud cloud;
    const Status read = read_cloud(folder.write("a.pcd", content), cloud);
    if (read) return std::string("none");
    EXPECT_THAT(read.error().message, HasSubstr("a.pcd: "));
    return read.error().message;
  };
  EXPECT_THAT(error_of(pcd("x y ring", "F F U", "4 4 1", "1 1 1\n1 1 1\n")),
              HasSubstr("expected the fields x, y and z; it has: x y ring"));
  EXPECT_THAT(error_of(pcd("x y z ring", "F F F F", "4 4 4 4", "1 1 1 1.5\n1 1 1 1\n")),
              HasSubstr("ring of point 0 is 1.5; expected a whole number from 0 to 255"));
  EXPECT_THAT(error_of(pcd("x y z ring", "F F F I", "4 4 4 4", "1 1 1 1\n1 1 1 256\n")),
              HasSubstr("ring of point 1 is 256"));
  EXPECT_THAT(error_of(pcd("x y z", "F F F", "4 4 4", "nan 1 1\n0 0 0\n")),
              HasSubstr("none of the 2 points is finite and not null"));
  EXPECT_THAT(error_of(pcd("x y z", "F F F", "4 4 4", "1 1 1\n1 1 1\n", "WIDTH 3\nHEIGHT 1\n")),
              HasSubstr("2 POINTS, but WIDTH 3 and HEIGHT 1"));
}

}  // namespace
}  // namespace terracut::cloud
