// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/sensor_rows.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/cloud/nearest_ring.hpp"
#include "firmware_io/cloud/row_doubt.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"

namespace terracut::cloud {
namespace {

using scan::kNoRing;
using scan::RingTable;
using scan::ScanPoint;
using testing::HasSubstr;

/// Beams from the origin, unevenly apart.
RingTable uneven_rings(int rings, double top_deg, double step_deg) {
  RingTable table;
  double elevation_deg = top_deg;
  for (int ring = 0; ring < rings; ++ring) {
    table.push_back({beams::deg_to_rad(elevation_deg), 0});
    elevation_deg -= step_deg * (1 + ring % 3);
  }
  return table;
}

/// A cloud that says which ring each point is of.
struct KnownCloud {
  std::vector<ScanPoint> points;
  std::vector<std::uint16_t> laser;  ///< By any numbering.
  std::vector<std::int16_t> ring;

  void shuffle() {
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::shuffle(order, std::mt19937(1));
    const KnownCloud before = *this;
    for (std::size_t i = 0; i < order.size(); ++i) {
      points[i] = before.points[order[i]];
      laser[i] = before.laser[order[i]];
      ring[i] = before.ring[order[i]];
    }
  }
};

template <class LaserOfRing>
KnownCloud known_cloud(const RingTable& table, int points_per_ring, LaserOfRing laser_of_ring) {
  KnownCloud cloud{
      synthetic::scan(table, {.ground_m = -1.73, .points_per_ring = points_per_ring}), {}, {}};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto ring = static_cast<std::int16_t>(i / static_cast<std::size_t>(points_per_ring));
    cloud.ring.push_back(ring);
    cloud.laser.push_back(static_cast<std::uint16_t>(laser_of_ring(ring)));
  }
  return cloud;
}

Expected<SensorRows> learnt_from(const CloudView& cloud) {
  return learn_rows(1, [&](std::size_t) -> Expected<CloudView> { return cloud; });
}

void expect_rings(const Expected<SensorRows>& rows, const CloudView& cloud,
                  const std::vector<std::int16_t>& rings) {
  ASSERT_TRUE(rows) << rows.error().message;
  scan::RingRecovery found;
  ASSERT_TRUE(RowFinder(*rows).find(cloud, found));
  EXPECT_EQ(found.ring_of_point, rings);
}

void expect_table(const RingTable& found, const RingTable& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t ring = 0; ring < found.size(); ++ring) {
    EXPECT_NEAR(beams::rad_to_deg(found[ring].elevation_rad),
                beams::rad_to_deg(expected[ring].elevation_rad), 0.02)
        << ring;
  }
}

TEST(SensorRows, ComeFromTheLasersNumbersWhateverTheNumberingAndTheOrderOfPoints) {
  const RingTable table = uneven_rings(32, 8, 0.5);
  KnownCloud cloud = known_cloud(table, 1800, [](int ring) { return ring * 11 % 32; });
  cloud.shuffle();
  const CloudView view{cloud.points, cloud.laser};
  const auto rows = learnt_from(view);
  expect_rings(rows, view, cloud.ring);
  EXPECT_EQ(rows->source, RowSource::kLaserNumbers);
  EXPECT_EQ(rows->columns, 1800);
  expect_table(rows->rings.table, table);
}

TEST(SensorRows, ComeFromTheOrganisationWithARowOrAColumnForEachLaser) {
  const RingTable table = uneven_rings(16, 15, 1);
  const KnownCloud cloud = known_cloud(table, 900, [](int) { return 0; });
  expect_rings(learnt_from({cloud.points, {}, 16}), {cloud.points, {}, 16}, cloud.ring);

  KnownCloud by_column = cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t to = i % 900 * 16 + i / 900;
    by_column.points[to] = cloud.points[i];
    by_column.ring[to] = cloud.ring[i];
  }
  const CloudView view{by_column.points, {}, 900};
  const auto rows = learnt_from(view);
  expect_rings(rows, view, by_column.ring);
  EXPECT_EQ(rows->source, RowSource::kOrganisation);
  EXPECT_EQ(rows->columns, 900);
}

TEST(SensorRows, ComeFromTheElevationsWhereNothingElseTellsThem) {
  for (const int rings : {8, 16, 40, 128}) {
    const RingTable table = uneven_rings(rings, 12, rings == 128 ? 0.12 : 0.4);
    KnownCloud cloud = known_cloud(table, 1024, [](int) { return 0; });
    cloud.shuffle();
    const auto rows = learnt_from({cloud.points});
    expect_rings(rows, {cloud.points}, cloud.ring);
    EXPECT_EQ(rows->source, RowSource::kElevations);
    expect_table(rows->rings.table, table);
  }
}

TEST(SensorRows, OfAnHdl64eAreFoundInAnyOrder) {
  // A unit of its own, not the nominal one that its lines are looked for with.
  RingTable table = scan::ring_table(hdl64e::nominal_hdl64e());
  for (std::size_t ring = 0; ring < table.size(); ++ring) {
    table[ring].elevation_rad += beams::deg_to_rad(ring % 3 == 0 ? 0.05 : -0.03);
  }
  KnownCloud cloud = known_cloud(table, 2000, [](int) { return 0; });
  auto rows = learnt_from({cloud.points});
  expect_rings(rows, {cloud.points}, cloud.ring);
  EXPECT_EQ(rows->source, RowSource::kKittiOrder);
  EXPECT_EQ(rows->columns, 2083);

  cloud.shuffle();
  rows = learnt_from({cloud.points});
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(rows->source, RowSource::kElevations);
  scan::RingRecovery found;
  ASSERT_TRUE(RowFinder(*rows).find({cloud.points}, found));
  std::size_t same = 0;
  for (std::size_t i = 0; i < cloud.ring.size(); ++i)
    same += found.ring_of_point[i] == cloud.ring[i];
  EXPECT_GT(static_cast<double>(same) / static_cast<double>(cloud.ring.size()), 0.99);
}

TEST(SensorRows, AreUpToTheMostLasersThereMayBe) {
  const RingTable table = uneven_rings(kMostLasers, 20, 0.06);
  const KnownCloud cloud = known_cloud(table, 600, [](int ring) { return kMostLasers - 1 - ring; });
  const CloudView view{cloud.points, cloud.laser};
  expect_rings(learnt_from(view), view, cloud.ring);
}

TEST(SensorRows, LeavePointsThatAreNoReturnsAndOfLasersNeverSeenWithoutOne) {
  const RingTable table = uneven_rings(16, 15, 1);
  KnownCloud cloud = known_cloud(table, 900, [](int ring) { return 15 - ring; });
  const auto rows = learnt_from({cloud.points, cloud.laser});
  ASSERT_TRUE(rows) << rows.error().message;
  cloud.points[3].x_m = std::numeric_limits<float>::quiet_NaN();
  cloud.points[4] = {};
  cloud.laser[5] = 16;
  scan::RingRecovery found;
  ASSERT_TRUE(RowFinder(*rows).find({cloud.points, cloud.laser}, found));
  for (const std::size_t point : {std::size_t{3}, std::size_t{4}, std::size_t{5}})
    EXPECT_EQ(found.ring_of_point[point], kNoRing);
  EXPECT_EQ(found.no_ring, 3U);
}

TEST(SensorRows, AreNotOneMoreForEachNumberThatStandsForNoReturn) {
  const RingTable table = uneven_rings(16, 15, 1);
  KnownCloud cloud = known_cloud(table, 900, [](int ring) { return ring; });
  for (const std::size_t i : {7U, 900U, 14'000U}) {
    cloud.points[i] = {};
    cloud.laser[i] = 255;
    cloud.ring[i] = kNoRing;
  }
  const auto rows = learnt_from({cloud.points, cloud.laser});
  expect_rings(rows, {cloud.points, cloud.laser}, cloud.ring);
  EXPECT_EQ(rows->rings.table.size(), 16U);
}

TEST(SensorRows, OfALaserWithoutReturnsInTheFirstCloudHaveTheirPlaceByItsNumber) {
  const RingTable table = uneven_rings(16, 15, 1);
  const KnownCloud whole = known_cloud(table, 900, [](int ring) { return 15 - ring; });
  std::vector<ScanPoint> points;
  std::vector<std::uint16_t> laser;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    if (whole.laser[i] == 9) continue;
    points.push_back(whole.points[i]);
    laser.push_back(whole.laser[i]);
  }
  expect_rings(learnt_from({points, laser}), {whole.points, whole.laser}, whole.ring);
}

TEST(SensorRows, AreThoseOfAnOpenFieldWhereMostLasersLookIntoTheSky) {
  const RingTable table = uneven_rings(64, 40, 0.6);
  KnownCloud cloud = known_cloud(table, 400, [](int ring) { return 63 - ring; });
  std::size_t in_the_sky = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (table[i / 400].elevation_rad < -0.02) continue;
    cloud.points[i] = {};
    cloud.ring[i] = kNoRing;
    ++in_the_sky;
  }
  ASSERT_GT(in_the_sky, cloud.points.size() / 2);
  for (const CloudView& view :
       {CloudView{cloud.points, cloud.laser}, CloudView{cloud.points, {}, 64}}) {
    const auto rows = learnt_from(view);
    expect_rings(rows, view, cloud.ring);
    EXPECT_EQ(rows->columns, 400);
    EXPECT_NEAR(rows->rings.table.back().elevation_rad, table.back().elevation_rad, 1e-3);
  }
}

TEST(SensorRows, AreThoseOfANarrowViewWithFewPointsALaser) {
  const RingTable table = uneven_rings(64, 20, 0.3);
  const KnownCloud whole = known_cloud(table, 512, [](int ring) { return ring; });
  KnownCloud view;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    if (i % 512 >= 85) continue;  // 60 degrees
    view.points.push_back(whole.points[i]);
    view.laser.push_back(whole.laser[i]);
    view.ring.push_back(whole.ring[i]);
  }
  const auto rows = learnt_from({view.points, view.laser});
  expect_rings(rows, {view.points, view.laser}, view.ring);
  expect_table(rows->rings.table, table);
  EXPECT_EQ(rows->columns, 512);
}

TEST(SensorRows, AreRefusedWhereAllLasersLookTheSameWay) {
  const RingTable table = uneven_rings(16, 8, 0.5);
  const KnownCloud cloud = known_cloud(table, 900, [](int ring) { return ring; });
  std::vector<ScanPoint> flat = cloud.points;  // by a driver that was not told its angles
  for (ScanPoint& point : flat) point.z_m = 0;
  // A room: no point of a laser is far from its cone, whichever laser that is.
  KnownCloud room = cloud;
  for (ScanPoint& point : room.points) {
    const float shrink = 1.5F / std::hypot(point.x_m, point.y_m);
    point = {point.x_m * shrink, point.y_m * shrink, point.z_m * shrink, 0};
  }
  std::vector<std::uint16_t> no_lasers(cloud.points.size());
  for (std::size_t i = 0; i < no_lasers.size(); ++i)
    no_lasers[i] = static_cast<std::uint16_t>(i % 16);
  for (const CloudView& view : {CloudView{flat, cloud.laser}, CloudView{flat, {}, 16},
                                CloudView{room.points, {}, 900},  // WIDTH and HEIGHT exchanged
                                CloudView{room.points, no_lasers}}) {
    const auto rows = learnt_from(view);
    ASSERT_FALSE(rows);
    EXPECT_THAT(rows.error().message, HasSubstr("look the same way as the one above them"));
  }
  EXPECT_TRUE(learnt_from({room.points, room.laser}));
}

TEST(SensorRows, ComeFromThePlacesWhereNobodyFilledInTheLasersNumbers) {
  const RingTable table = uneven_rings(16, 15, 1);
  const KnownCloud cloud = known_cloud(table, 900, [](int) { return 0; });
  const auto rows = learnt_from({cloud.points, cloud.laser});
  expect_rings(rows, {cloud.points, cloud.laser}, cloud.ring);
  EXPECT_EQ(rows->source, RowSource::kElevations);
  EXPECT_EQ(learnt_from({cloud.points, cloud.laser, 16})->source, RowSource::kOrganisation);
}

TEST(SensorRows, OfACloudWithoutAPlaceAreNoneWhateverItLacks) {
  const RingTable table = uneven_rings(16, 15, 1);
  const KnownCloud cloud = known_cloud(table, 900, [](int ring) { return ring; });
  const std::vector<ScanPoint> blind(7);
  EXPECT_THAT(learnt_from({blind, std::vector<std::uint16_t>(7)}).error().message,
              HasSubstr("none of the 7 points is finite"));
  const RingTable hdl64e = scan::ring_table(hdl64e::nominal_hdl64e());
  const KnownCloud kitti = known_cloud(hdl64e, 900, [](int) { return 0; });
  for (const CloudView& seen :
       {CloudView{cloud.points, cloud.laser}, CloudView{cloud.points, {}, 16},
        CloudView{cloud.points}, CloudView{kitti.points}}) {
    // The blind one comes first, and tells nothing.
    const auto rows = learn_rows(
        2, [&](std::size_t i) -> Expected<CloudView> { return i == 0 ? CloudView{blind} : seen; });
    ASSERT_TRUE(rows) << rows.error().message;
    for (const CloudView& none : {CloudView{blind}, CloudView{}}) {
      scan::RingRecovery found;
      ASSERT_TRUE(RowFinder(*rows).find(none, found));
      EXPECT_EQ(found.rings, static_cast<int>(rows->rings.table.size()));
      EXPECT_EQ(found.ring_of_point, std::vector<std::int16_t>(none.points.size(), kNoRing));
      EXPECT_EQ(found.no_ring, none.points.size());
    }
  }
}

TEST(SensorRows, AreDoubtedWhereTheirPointsAreOfTwoSensorsOrInAVehiclesFrame) {
  KnownCloud cloud = known_cloud(uneven_rings(16, 15, 1), 900, [](int ring) { return ring; });
  EXPECT_EQ(doubt_of(*learnt_from({cloud.points, cloud.laser})), "");
  KnownCloud apart = cloud, high = cloud;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    apart.points[i].x_m += i % 2 == 0 ? 1.5F : -1.5F;
    high.points[i].z_m += 1.6F;
  }
  const auto two = learnt_from({apart.points, apart.laser});
  ASSERT_TRUE(two) << two.error().message;
  EXPECT_THAT(doubt_of(*two), HasSubstr("of several sensors or revolutions"));
  const auto vehicle = learnt_from({high.points, high.laser});
  ASSERT_TRUE(vehicle) << vehicle.error().message;
  EXPECT_THAT(doubt_of(*vehicle), HasSubstr("start 1.60 m above the origin"));
}

TEST(SensorRows, AreThoseThatSeeNothingBeyondAMetre) {
  // Of a robot half a metre high, which looks straight down at the floor and the steps beside it.
  for (const int rings : {60, 64}) {  // the latter as many as in KITTI's order
    const RingTable table = uneven_rings(rings, 52, 0.8);
    std::vector<ScanPoint> points =
        synthetic::scan(table, {.ground_m = -0.5, .points_per_ring = 600});
    for (const bool is_from_the_top : {true, false}) {
      if (!is_from_the_top) std::ranges::reverse(points);
      const auto rows = learnt_from({points});
      ASSERT_TRUE(rows) << rows.error().message;
      EXPECT_EQ(rows->source, RowSource::kElevations);
      expect_table(rows->rings.table, table);
    }
  }
  const RingTable table = uneven_rings(60, 52, 0.8);
  const std::vector<ScanPoint> points =
      synthetic::scan(table, {.ground_m = -0.5, .points_per_ring = 600});
  // Between rows that see far, too.
  std::vector<ScanPoint> some_near = points;
  for (std::size_t i = 0; i < 600; ++i) {
    ScanPoint& point = some_near[20 * 600 + i];
    const float shrink = 0.8F / std::hypot(point.x_m, point.y_m);
    point = {point.x_m * shrink, point.y_m * shrink, point.z_m * shrink, 0};
  }
  expect_table(learnt_from({some_near})->rings.table, table);
}

TEST(SensorRows, AreNotTakenFromNearPointsOfBeamsThatStartBesideTheOrigin) {
  const RingTable table = uneven_rings(32, 20, 0.8);
  std::vector<ScanPoint> points = synthetic::scan(table, {.points_per_ring = 900});
  const auto without = learnt_from({points});
  ASSERT_TRUE(without) << without.error().message;
  for (int i = 0; i < 900; ++i) {  // the edge of a roof
    const float distance_m = 0.5F + 0.3F * static_cast<float>(i % 100) / 100;
    points.push_back({distance_m, 0, -0.3F * distance_m - 0.02F, 0});
  }
  const auto with = learnt_from({points});
  ASSERT_TRUE(with) << with.error().message;
  EXPECT_EQ(with->rings.table.size(), without->rings.table.size());
}

TEST(SensorRows, AreNotSeenInTheFewPointsOfADrawing) {
  std::vector<ScanPoint> curve;
  for (int i = 0; i < 110; ++i) {
    const auto angle = static_cast<float>(i / 3 * 3) / 100;
    curve.push_back({3 * std::cos(angle), 3 * std::cos(angle), 3 * std::sin(angle), 0});
  }
  const auto rows = learnt_from({curve});
  ASSERT_FALSE(rows);
  EXPECT_THAT(rows.error().message, HasSubstr("110 points form 37 rows"));
}

TEST(SensorRows, AreRefusedWhereThereAreNone) {
  std::vector<ScanPoint> points;
  std::mt19937 random(1);
  for (int i = 0; i < 50'000; ++i) {
    const auto unit = [&] { return static_cast<float>(random()) / 4294967296.0F; };
    points.push_back({40 * unit() - 20, 40 * unit() - 20, 6 * unit() - 2, 0});
  }
  const auto rows = learnt_from({points});
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(rows.error().message, HasSubstr("nothing tells which laser measured a point"));

  std::vector<std::uint16_t> laser(points.size());
  for (std::size_t i = 0; i < laser.size(); ++i) laser[i] = static_cast<std::uint16_t>(i % 16);
  EXPECT_THAT(learnt_from({points, laser}).error().message, HasSubstr("look the same way"));
  std::vector<std::uint16_t> many(points.size());
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::uint16_t>(i % 300);
  EXPECT_THAT(learnt_from({points, many}).error().message,
              HasSubstr("300 lasers by the field of the laser's number; expected 8 to 256"));
  for (std::uint16_t& number : laser) number %= 4;
  EXPECT_THAT(learnt_from({points, laser}).error().message,
              HasSubstr("the laser of a point has only 4 different numbers, not organised"));
  EXPECT_THAT(learnt_from({points, laser, 1, "field beam"}).error().message,
              HasSubstr("field beam has only 4 different numbers, not organised"));
  laser.pop_back();
  EXPECT_THAT(learnt_from({points, laser}).error().message, HasSubstr("49999 numbers of lasers"));
}

TEST(SensorRows, AreRefusedInTheFrameOfAMap) {
  KnownCloud cloud = known_cloud(uneven_rings(16, 15, 1), 900, [](int ring) { return ring; });
  for (ScanPoint& point : cloud.points) point = {point.x_m + 20, point.y_m, point.z_m + 5, 0};
  const auto rows = learnt_from({cloud.points, cloud.laser});
  ASSERT_FALSE(rows);
  EXPECT_THAT(rows.error().message, HasSubstr("do not lie on a cone around the origin"));
}

TEST(SensorRows, AreRefusedToACloudThatLacksWhatToldThemInTheFirst) {
  const RingTable table = uneven_rings(16, 15, 1);
  const KnownCloud cloud = known_cloud(table, 900, [](int ring) { return ring; });
  scan::RingRecovery found;
  const auto numbered = learnt_from({cloud.points, cloud.laser});
  EXPECT_EQ(RowFinder(*numbered).find({cloud.points}, found).error().code, ErrorCode::kMalformed);
  const auto organised = learnt_from({cloud.points, {}, 16});
  EXPECT_EQ(RowFinder(*organised).find({cloud.points}, found).error().code, ErrorCode::kMalformed);
  EXPECT_EQ(RowFinder(*organised).find({cloud.points, {}, 8}, found).error().code,
            ErrorCode::kMalformed);
}

TEST(NearestRing, OfAPointThatIsNextToTheOriginIsNone) {
  const NearestRing nearest({{0.1, 0}, {0, 0}, {-0.1, 0}});
  EXPECT_EQ(nearest({1e-30F, 0, 1e-30F, 0}), scan::kNoRing);
  EXPECT_EQ(nearest({10, 0, 0, 0}), 1);
}

}  // namespace
}  // namespace terracut::cloud
