// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Clouds of named fields through `segment`.
#include <algorithm>
#include <cmath>
#include <string>

#include "cli_fixture.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Place {
  double x_m, y_m, z_m;
};

constexpr int kRings = 16, kColumns = 900, kPoints = kRings * kColumns;

/// Of laser `ring` of 16, 1.8 m above level ground with a wall around it.
Place seen_by(int ring, int column, double degrees_apart = 2) {
  const double slope = std::tan((ring - 7.5) * degrees_apart * M_PI / 180),
               azimuth = column * M_PI / 450;
  const double wall_m = 20 + 10 * std::sin(5 * azimuth);
  const double distance_m = slope < 0 ? std::min(wall_m, -1.8 / slope) : wall_m;
  return {distance_m * std::cos(azimuth), distance_m * std::sin(azimuth), distance_m * slope};
}

Place as_seen(int /*point*/, const Place& place) {
  return place;
}

constexpr const char* kAtOrigin = "0 0 0 1 0 0 0";

/// A cloud whose points are moved by `move(point, place)`. Sensors' ring of each is `ring(point)`.
template <class Move, class Ring>
void write_cloud(const fs::path& file, const Move& move, const Ring& ring,
                 const std::string& viewpoint = kAtOrigin) {
  fs::create_directories(file.parent_path());
  std::ofstream pcd(file);
  pcd.precision(12);
  pcd << "VERSION .7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH "
      << kPoints << "\nHEIGHT 1\nVIEWPOINT " << viewpoint << "\nPOINTS " << kPoints
      << "\nDATA ascii\n";
  for (int point = 0; point < kPoints; ++point) {
    const Place at = move(point, seen_by(point / kColumns, point % kColumns));
    pcd << at.x_m << ' ' << at.y_m << ' ' << at.z_m << ' ' << ring(point) << '\n';
  }
}

int laser_of(int point) {
  return point / kColumns;
}

/// Of all labels fewer than one in 500 differ.
void expect_alike(const std::vector<std::uint32_t>& labels,
                  const std::vector<std::uint32_t>& others) {
  ASSERT_EQ(labels.size(), others.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) differ += labels[i] != others[i] ? 1U : 0U;
  EXPECT_LT(differ, labels.size() / 500);
}

class CliClouds : public Cli {
 protected:
  void write_clouds(const std::string& folder, int count, const std::string& ending = ".pcd") {
    for (int i = 0; i < count; ++i) {
      write_cloud(folder_ / folder / ("00000" + std::to_string(i) + ending), as_seen, laser_of);
    }
  }
};

TEST_F(CliClouds, OfOneNameAreRefusedBeforeWorkStarts) {
  write_clouds("scans", 2);
  write_clouds("scans", 1, ".PCD");
  for (const std::string output : {"--labels", "--pcd", "--png"}) {
    const Outcome outcome = run("segment scans " + output + " made");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("000000.PCD"), HasSubstr("000000.pcd"),
                                   HasSubstr("two scans of one name")));
    EXPECT_FALSE(fs::exists(folder_ / "made"));
  }
  expect_done("segment scans/000000.PCD --labels made");
}

TEST_F(CliClouds, OfOneFolderNeverTakeAwayTheLabelsOfAnother) {
  write_clouds("two", 2);
  write_clouds("one", 1);
  expect_done("segment two --labels labels");
  const Outcome other = run("segment one --labels labels");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, AllOf(HasSubstr("there are 2 .label files in it that were made of "),
                               HasSubstr("/two,"), HasSubstr("--overwrite")));
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), 2u);
  const std::string said = "labels: 2 .label files of an earlier run were taken away";
  EXPECT_THAT(run("segment two --labels labels").err, HasSubstr(said)) << "the same input";
  EXPECT_THAT(run("segment one --labels labels --overwrite").err, HasSubstr(said));
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), 1u);
}

TEST_F(CliClouds, OfTwoSensorsInOneAreLabelledWithoutRowsWhichIsSaidOnce) {
  const auto two_places = [](int point, const Place& place) {
    const double apart_m = point % 2 == 0 ? 1.5 : -1.5;
    return Place{place.x_m + apart_m, place.y_m, place.z_m};
  };
  for (const char* name : {"000000.pcd", "000001.pcd", "000002.pcd"}) {
    write_cloud(folder_ / "merged" / name, two_places, laser_of);
  }
  const Outcome outcome = run("segment merged --labels labels --json report.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string reason = "no lasers show: the points of a laser lie up to ";
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(" by bins of elevation"), HasSubstr(reason)));
  EXPECT_EQ(outcome.err.find(reason), outcome.err.rfind(reason));
  write_clouds("single", 1);
  expect_done("segment single --json report.json");
  EXPECT_FALSE(json("report.json").contains("sensor_warning"));
}

TEST_F(CliClouds, InFeetAreLabelledWithAWarning) {
  const auto to_feet = [](int point, const Place& /*place*/) {
    const Place place = seen_by(point / kColumns, point % kColumns, 6);
    return Place{place.x_m / 0.3048, place.y_m / 0.3048, place.z_m / 0.3048};
  };
  write_cloud(folder_ / "feet.pcd", to_feet, laser_of);
  const Outcome outcome = run("segment feet.pcd --labels labels --json report.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: feet.pcd: the sensor stands 5.9 m above"));
  EXPECT_THAT(json("report.json")["sensor_warning"], HasSubstr("are the points feet?"));
}

TEST_F(CliClouds, AreSeenFromTheirViewpointWhereTheyAreNotAroundTheOrigin) {
  write_clouds("own", 1);
  expect_done("segment own --labels own_labels");
  // A quarter turn to the left, then 5 m ahead, 2 m to the right, 1.8 m up.
  const auto to_map = [](int /*point*/, const Place& place) {
    return Place{5 - place.y_m, -2 + place.x_m, 1.8 + place.z_m};
  };
  const std::string half = std::to_string(std::sqrt(0.5));
  write_cloud(folder_ / "map/000000.pcd", to_map, laser_of, "5 -2 1.8 " + half + " 0 0 " + half);
  const Outcome outcome = run("segment map --labels map_labels");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("stood at each file's VIEWPOINT"));
  const auto own = ids_of(folder_ / "own_labels/000000.label");
  expect_alike(own, ids_of(folder_ / "map_labels/000000.label"));

  // Drivers also write where in a map they were, beside points in their own frame.
  write_cloud(folder_ / "driven/000000.pcd", as_seen, laser_of, "5 -2 1.8 0.5 0.5 0.5 0.5");
  const Outcome driven = run("segment driven --labels driven_labels");
  ASSERT_EQ(driven.exit_code, 0) << driven.err;
  EXPECT_THAT(driven.err, Not(HasSubstr("VIEWPOINT")));
  EXPECT_EQ(ids_of(folder_ / "driven_labels/000000.label"), own);

  // Where neither fits, the cones of the lasers tell the place.
  write_cloud(folder_ / "wrong/000000.pcd", to_map, laser_of, "50 -2 1.8 1 0 0 0");
  const Outcome wrong = run("segment wrong");
  EXPECT_EQ(wrong.exit_code, 0) << wrong.err;
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("sensor: stood 5.00 -2.00 1.80 m from the origin"),
                               HasSubstr("by the cones of its lasers")));
}

TEST_F(CliClouds, OfATiltedSensorInALevelledFrameGetTheLabelsOfItsOwn) {
  write_clouds("own", 1);
  expect_done("segment own --labels own_labels");
  const double cosine = std::cos(0.26), sine = std::sin(0.26);
  const auto levelled = [&](int /*point*/, const Place& place) {
    return Place{cosine * place.x_m + sine * place.z_m, place.y_m,
                 cosine * place.z_m - sine * place.x_m};
  };
  write_cloud(folder_ / "levelled/000000.pcd", levelled, laser_of);
  const Outcome outcome = run("segment levelled --labels levelled_labels");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("its axis 14.9 degrees from theirs"));
  expect_alike(ids_of(folder_ / "own_labels/000000.label"),
               ids_of(folder_ / "levelled_labels/000000.label"));
}

TEST_F(CliClouds, ThatTellNoLaserSayWhichOfTheirFieldsDoNotAndAreRefusedWithoutAGround) {
  const auto scattered = [](int point, const Place& place) {
    return Place{place.x_m, place.y_m, place.z_m + (point * 7919 % 1000) * 0.003};
  };
  write_cloud(folder_ / "zero.pcd", scattered, [](int) { return 0; });
  const Outcome outcome = run("segment zero.pcd");
  EXPECT_EQ(outcome.exit_code, 10);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(" by bins of elevation"),
                                 HasSubstr("no lasers show: nothing tells which laser"),
                                 HasSubstr("field ring has only 1 different number, ")));
  write_cloud(folder_ / "one.pcd", scattered, [](int) { return 77; });
  EXPECT_THAT(run("segment one.pcd").err, HasSubstr("field ring has only 1 different number, "));
  write_cloud(folder_ / "few.pcd", scattered, [](int point) { return point % 3; });
  EXPECT_THAT(run("segment few.pcd").err, HasSubstr("field ring has only 3 different numbers"));
  write_cloud(folder_ / "odd.pcd", scattered, [](int point) { return point + 300; });
  EXPECT_THAT(run("segment odd.pcd").err,
              HasSubstr("no field with its number (ring of point 0 is 300, expected a whole"));
}

TEST_F(CliClouds, OfASensorWithoutRowsAreSimulatedWithTheirTruthAndLabelled) {
  expect_done("simulate --pattern avia --duration 0.2 -o made");
  EXPECT_EQ(ids_of(folder_ / "made/labels/000001.label").size(),
            fs::file_size(folder_ / "made/velodyne/000001.bin") / 16);
  const Outcome outcome = run("segment made --labels labels --json report.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" by bins of elevation"));
  EXPECT_GT(json("report.json")["summary"]["iou_g"], 0.9);
  EXPECT_EQ(run("simulate --pattern avia --sensor vlp16 -o made").exit_code, 2);
}

TEST_F(CliClouds, ThatAreDamagedAreNamedAndTheOthersOfTheFolderLabelled) {
  write_clouds("drive", 5);
  for (const char* damaged : {"drive/000000.pcd", "drive/000003.pcd"}) {
    const std::string whole = content_of(folder_ / damaged);
    write(damaged, whole.substr(0, whole.size() / 2));
  }
  write("drive/000004.label", "seven b");
  for (const char* covered : {"drive/000005.pcd", "drive/000006.pcd", "drive/000007.pcd"}) {
    write_cloud(folder_ / covered, [](int, const Place&) { return Place{0, 0, 0}; }, laser_of);
  }
  const Outcome outcome = run("segment drive --labels labels --json report.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning: drive/000000.pcd: line "),
                                 HasSubstr("warning: drive/000003.pcd: line "),
                                 HasSubstr("warning: drive/000004.label"),
                                 HasSubstr("error: 3 of 8 clouds, or their truth,")));
  EXPECT_THAT(outcome.out, HasSubstr("frames    6"));
  EXPECT_EQ(files_in(folder_ / "labels", ".label"), 6U);
  EXPECT_TRUE(fs::exists(folder_ / "labels/000004.label"));
  EXPECT_EQ(json("report.json")["frames"].size(), 6U);
  EXPECT_THAT(json("report.json")["input_warning"], HasSubstr("000000.pcd"));
}

TEST_F(CliClouds, AreThereAtOnceSoNothingIsLeftOfTheWorkAfterAFrame) {
  write_clouds("drive", 1);
  const Outcome outcome = run("segment drive --json report.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("total"), Not(HasSubstr("after_frame"))));
  EXPECT_FALSE(json("report.json")["frames"][0]["ms"].contains("after_frame"));
  EXPECT_FALSE(json("report.json")["summary"]["ms"].contains("after_frame"));
}

}  // namespace
}  // namespace terracut::cli
