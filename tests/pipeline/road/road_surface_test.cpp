// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/road_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::road {
namespace {

constexpr double kKerb_m = 0.12;

struct RoadSurfaceOfAFrame : testing::Test, test::BoxScene {
  RoadSurfaceOfAFrame() { config.road.enabled = true; }

  std::span<const frame::Label> segment(const test::BeamCast& beams) {
    cast(beams);
    return resegment();
  }
  std::span<const frame::Label> resegment() {
    segmenter = std::make_unique<ground::Segmenter>(config, profile, kShape,
                                                    image.return_capacity(), memory);
    report = segmenter->segment(image);
    return segmenter->labels();
  }
  /// Share of the returns of a rectangle, as far as they are ground, that are road surface.
  double road_share(double near_m, double far_m, double right_m, double left_m) const {
    const auto within = [=](float x, float y, float) {
      return x > near_m && x < far_m && y > right_m && y < left_m;
    };
    const double road = share(segmenter->labels(), frame::Label::kGround, within);
    const double other = share(segmenter->labels(), frame::Label::kOtherGround, within);
    return road / (road + other);
  }
  /// A road 7 m wide; a pavement 2 m wide on the left with a gap, level ground behind it; the same
  /// on the right without a gap.
  static test::BeamCast street(double gap_m) {
    return test::ground_with_boxes({{-60, 8, 3.5, 5.5, -1, kKerb_m},
                                    {8 + gap_m, 60, 3.5, 5.5, -1, kKerb_m},
                                    {-60, 60, -5.5, -3.5, -1, kKerb_m}});
  }
  double azimuth_of(int column) const {
    return 2 * std::numbers::pi * (column + 0.5) / kShape.columns;
  }
  double elevation_of(int row) const {
    return profile.rings[static_cast<std::size_t>(row)].elevation_rad;
  }
  /// Share of a frame from straight behind to a column.
  double since_behind(int column) const {
    return static_cast<double>((column + kShape.columns / 2) % kShape.columns) / kShape.columns;
  }
  /// A frame from `first_column` on, while the vehicle came down by 15 cm between straight behind
  /// and straight behind again. So few rings see it that only the order of arrival tells the step
  /// there from a kerb.
  void place_frame_of_sinking_vehicle(int first_column) {
    image.clear();
    for (int n = 0; n < kShape.columns; ++n) {
      const int column = (first_column + n) % kShape.columns;
      for (int row = 0; row < kShape.rows; ++row) {
        const double azimuth_rad = azimuth_of(column), elevation_rad = elevation_of(row);
        const double d = test::flat_ground()(azimuth_rad, elevation_rad);
        if (!(d > 0) || d > 6) continue;
        place(row, column, d * std::cos(elevation_rad), 0.15 * since_behind(column));
      }
    }
  }
  /// Puts a return into a cell, so far away and so high.
  void place(int row, int column, double across_m, double z_m) {
    const double azimuth_rad = azimuth_of(column);
    image.place(row, column,
                {static_cast<float>(across_m * std::cos(azimuth_rad)),
                 static_cast<float>(-across_m * std::sin(azimuth_rad)), static_cast<float>(z_m),
                 static_cast<float>(across_m), 0});
  }
  /// The same world with the sensor's ground plane inclined: rises by so much a metre.
  static test::BeamCast inclined(const test::BeamCast& beams, double rise) {
    return [=](double azimuth_rad, double elevation_rad) {
      // Pitched by the angle of the slope, about the point on the ground below the sensor.
      const double pitch_rad = std::atan(rise);
      const double x = std::cos(elevation_rad) * std::cos(azimuth_rad);
      const double y = -std::cos(elevation_rad) * std::sin(azimuth_rad);
      const double z = std::sin(elevation_rad);
      const double along = x * std::cos(pitch_rad) + z * std::sin(pitch_rad);
      const double up = z * std::cos(pitch_rad) - x * std::sin(pitch_rad);
      return beams(std::atan2(-y, along), std::asin(up));
    };
  }

  ground::SegmenterConfig config;
  std::unique_ptr<ground::Segmenter> segmenter;
  stage::SegmentationReport report;
};

TEST_F(RoadSurfaceOfAFrame, EndsAtTheKerb) {
  segment(street(0));
  EXPECT_GT(road_share(4, 25, -3, 3), 0.99);
  EXPECT_EQ(road_share(-15, 20, 3.8, 5.5), 0.0) << "the pavement";
  EXPECT_EQ(road_share(-15, 20, 6, 12), 0.0) << "level with the road, but behind the pavement";
  EXPECT_EQ(road_share(-15, 20, -12, -3.8), 0.0);
}

TEST_F(RoadSurfaceOfAFrame, LeadsThroughAGapInTheKerbThatIsWideEnoughForTheVehicle) {
  segment(street(6));
  EXPECT_GT(road_share(0, 15, 7, 12), 0.8);
  EXPECT_EQ(road_share(-15, 20, -12, -3.8), 0.0) << "the other side";
}

TEST_F(RoadSurfaceOfAFrame, DoesNotLeadThroughAGapThatIsNot) {
  segment(street(1.8));
  EXPECT_EQ(road_share(-15, 20, 6, 12), 0.0);
  config.road.vehicle_width_m = 0.4F;
  resegment();
  EXPECT_GT(road_share(0, 15, 7, 12), 0.8) << "for a narrower vehicle it is one";
}

TEST_F(RoadSurfaceOfAFrame, IsTheSameUphillDownhillAndUnderATiltedSensor) {
  for (const double rise : {0.15, -0.15, 0.087}) {
    segment(inclined(street(0), rise));
    EXPECT_GT(road_share(5, 15, -2.5, 2.5), 0.99) << rise;
    EXPECT_LT(road_share(-8, 15, 3.9, 5.4), 0.05) << rise;
  }
}

TEST_F(RoadSurfaceOfAFrame, EndsWhereTheGroundIsRough) {
  // Ground beyond y = 4 that is up and down by 2 cm from one beam to the next: mown grass.
  const auto grass = [](double azimuth_rad, double elevation_rad) {
    const double level = test::flat_ground()(azimuth_rad, elevation_rad);
    const double y = -level * std::cos(elevation_rad) * std::sin(azimuth_rad);
    const bool odd = static_cast<int>(azimuth_rad * 1000 / 6.2831853) % 2 != 0;
    return level > 0 && y > 4 && odd ? test::flat_ground(1.71)(azimuth_rad, elevation_rad) : level;
  };
  segment(grass);
  EXPECT_GT(road_share(4, 20, -10, 3), 0.99);
  EXPECT_EQ(road_share(-10, 20, 5, 15), 0.0);
}

TEST_F(RoadSurfaceOfAFrame, DoesNotEndAtTheNoiseOfASingleRing) {
  // One laser that sees a step of 10 cm in the middle of nowhere.
  constexpr int kRow = 30;
  for (int row = 0; row < kShape.rows; ++row) {
    for (int column = 0; column < kShape.columns; ++column) {
      const double elevation_rad = elevation_of(row);
      const double d = test::flat_ground()(azimuth_of(column), elevation_rad);
      if (!(d > 0) || d > 60) continue;
      const bool step = row == kRow && column > 980;
      place(row, column, d * std::cos(elevation_rad), step ? 0.1 : 0.0);
    }
  }
  resegment();
  EXPECT_GT(road_share(4, 30, -2, 2), 0.97);
}

TEST_F(RoadSurfaceOfAFrame, DoesNotEndWhereTheFrameEnds) {
  place_frame_of_sinking_vehicle(kShape.columns / 2);
  resegment();
  EXPECT_GT(road_share(-6, -4, -0.1, 0.1), 0.97);
  place_frame_of_sinking_vehicle(0);  // had it begun ahead, there would be a step behind
  resegment();
  EXPECT_LT(road_share(-6, -4, -0.1, 0.1), 0.1);
}

TEST_F(RoadSurfaceOfAFrame, IsTheSameHoweverOftenItWasSeenBefore) {
  place_frame_of_sinking_vehicle(0);
  resegment();
  const std::vector<frame::Label> first(segmenter->labels().begin(), segmenter->labels().end());
  for (int frame = 1; frame < 5; ++frame) {
    (void)segmenter->segment(image);
    EXPECT_TRUE(std::ranges::equal(segmenter->labels(), first)) << "after " << frame;
  }
}

TEST_F(RoadSurfaceOfAFrame, LeadsAcrossTwoRingsWithoutReturns) {
  // Both beyond the track that the way begins on; 13 m away, rings are 0.7 m apart.
  segment([](double azimuth_rad, double elevation_rad) {
    const double d = test::flat_ground()(azimuth_rad, elevation_rad);
    const double range_m = d * std::cos(elevation_rad);
    return range_m > 12.8 && range_m < 14.3 ? -1.0 : d;
  });
  EXPECT_GT(road_share(15, 25, -3, 3), 0.97);
}

TEST_F(RoadSurfaceOfAFrame, DoesNotEndAtTheSeamOfACompensatedFrame) {
  // Returns moved to where they are seen from in the middle of a frame from behind to behind, then
  // put back on their laser's rays, in another order.
  constexpr double kDriven_m = 1.2;
  for (int row = 0; row < kShape.rows; ++row) {
    const double elevation_rad = elevation_of(row);
    for (int column = 0; column < kShape.columns; ++column) {
      const double azimuth_rad = azimuth_of(column);
      const double d = test::flat_ground()(azimuth_rad, elevation_rad);
      if (!(d > 0) || d > 60) continue;
      const double moved_m = kDriven_m * (since_behind(column) - 0.5) * std::cos(azimuth_rad);
      place(row, column, d * std::cos(elevation_rad) + moved_m, moved_m * std::tan(elevation_rad));
    }
  }
  resegment();
  EXPECT_GT(road_share(-20, -4.5, -1, 1), 0.97);
}

TEST_F(RoadSurfaceOfAFrame, EndsAtAKerbUnderTheVehicleThatEndsNearBy) {
  // The vehicle stands with its left wheels on a pavement that ends 8 m behind it.
  segment(test::ground_with_boxes({{-8, 0, 0.05, 4, -1, kKerb_m}}));
  EXPECT_EQ(road_share(-7, -4.5, 0.2, 3.5), 0.0);
  EXPECT_GT(road_share(-9, -4.5, -5, -0.5), 0.97);
}

TEST_F(RoadSurfaceOfAFrame, LeadsToBothSidesOfAnEdgeUnderTheVehicleThatLeadsFarAway) {
  for (const test::Box& higher_side :
       {test::Box{-60, 0, 0.05, 6, -1, kKerb_m}, test::Box{-60, 0, -6, -0.05, -1, kKerb_m}}) {
    segment(test::ground_with_boxes({higher_side}));
    EXPECT_GT(road_share(-9, -4.5, 0.5, 5), 0.97);
    EXPECT_GT(road_share(-9, -4.5, -5, -0.5), 0.97);
  }
}

TEST_F(RoadSurfaceOfAFrame, EndsAtAKerbBesideTheVehicleHoweverFarItLeads) {
  segment(test::ground_with_boxes({{-60, 60, 1.3, 6, -1, kKerb_m}}));
  EXPECT_LT(road_share(-15, 15, 1.5, 5.5), 0.01);
}

TEST_F(RoadSurfaceOfAFrame, DoesNotGoOnBehindAWall) {
  // Walls around the vehicle, low enough for the ground behind them to be seen.
  segment(test::ground_with_boxes({{8, 8.3, -60, 60, -1, 0.8},
                                   {-8.3, -8, -60, 60, -1, 0.8},
                                   {-60, 60, 8, 8.3, -1, 0.8},
                                   {-60, 60, -8.3, -8, -1, 0.8}}));
  EXPECT_GT(road_share(4, 6, -3, 3), 0.99);
  EXPECT_EQ(road_share(16, 40, -20, 20), 0.0);
}

TEST_F(RoadSurfaceOfAFrame, IsTheSameWhereverTheSeamOfTheImageLies) {
  // Kerbs, bumps that bar the way and bumps that are noise; then the same seen from a vehicle that
  // stands the other way round, so that what was at the seam is in the middle of the image.
  constexpr frame::ImageShape kHalves{64, 1080};  // halves of whole patches and sectors
  frame::RangeImage frame(kHalves, 0, memory);
  std::mt19937 random(5);
  const auto between = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (int trial = 0; trial < 16; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<test::Box> boxes{{-60, 8, 3.5, 5.5, -1, kKerb_m},
                                 {-60, 60, -5.5, -3.5, -1, kKerb_m}};
    // Many anywhere, or few and narrow ones at the seam, which only those beyond it tell from
    // noise.
    const bool is_few = trial % 2 != 0;
    for (int n = 0; n < (is_few ? 6 : 40); ++n) {
      const double x = between(4, 20), y = is_few ? between(-0.4, 0.3) : between(-2, 2);
      const double length_m = is_few ? between(0.3, 1) : between(0.1, 3);
      const double width_m = is_few ? between(0.05, 0.2) : between(0.1, 0.6);
      boxes.push_back({x, x + length_m, y, y + width_m, -1, between(0.02, 0.14)});
    }
    const auto beams = test::ground_with_boxes(boxes);
    std::vector<frame::Label> cells[2];
    for (const int half_revolutions : {0, 1}) {
      test::cast_frame(
          profile,
          [&](double azimuth_rad, double elevation_rad) {
            return beams(azimuth_rad + half_revolutions * std::numbers::pi, elevation_rad);
          },
          frame);
      ground::Segmenter of_halves(config, profile, kHalves, frame.return_capacity(), memory);
      (void)of_halves.segment(frame);
      for (int row = 0; row < kHalves.rows; ++row) {
        for (int column = 0; column < kHalves.columns; ++column) {
          const int rotated = (column + half_revolutions * kHalves.columns / 2) % kHalves.columns;
          const std::size_t cell = kHalves.cell(row, rotated);
          cells[half_revolutions].push_back(frame.has_return(cell)
                                                ? of_halves.labels()[frame.return_index()[cell]]
                                                : frame::Label::kNone);
        }
      }
    }
    EXPECT_EQ(cells[0], cells[1]);
    EXPECT_GT(std::ranges::count(cells[0], frame::Label::kGround), 1000);
    EXPECT_GT(std::ranges::count(cells[0], frame::Label::kOtherGround), 1000);
  }
}

TEST_F(RoadSurfaceOfAFrame, ChangesNothingButWhichGroundItIs) {
  const auto beams = street(6);
  segment(beams);
  const std::vector<frame::Label> with(segmenter->labels().begin(), segmenter->labels().end());
  const stage::SegmentationReport report_with = report;
  config.road.enabled = false;
  const auto without = resegment();
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    ASSERT_NE(without[i], frame::Label::kOtherGround);
    ASSERT_EQ(frame::is_ground(with[i]), frame::is_ground(without[i]));
  }
  EXPECT_EQ(report.other_ground, 0U);
  EXPECT_EQ(report_with.ground, report.ground);
  EXPECT_EQ(report_with.other_ground,
            std::count(with.begin(), with.end(), frame::Label::kOtherGround));
  EXPECT_GT(report_with.other_ground, 0U);
}

TEST_F(RoadSurfaceOfAFrame, CountsTheSecondReturnOfACellWhereTheCellIs) {
  cast(street(0));
  const auto double_up = [&](float least_y, float most_y) {
    std::vector<frame::Return> returns;
    std::vector<std::pair<int, int>> cells;
    for (int row = 5; row < 30; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const auto cell = static_cast<std::size_t>(row * kShape.stride() + column);
        const frame::Return point{image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                                  image.ground_range_m()[cell], 0};
        if (point.x_m < 5 || point.x_m > 12 || point.y_m < least_y || point.y_m > most_y) continue;
        returns.push_back(point);
        cells.emplace_back(row, column);
      }
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(returns.size(), 100); ++i) {
      ASSERT_TRUE(image.place(cells[i].first, cells[i].second, returns[i]));
    }
  };
  double_up(-1, 1);
  double_up(4, 5);
  const auto labels = resegment();
  ASSERT_GT(image.overflow().size(), 50U);
  for (const frame::OverflowReturn& extra : image.overflow()) {
    const frame::Label expected =
        extra.point.y_m < 2 ? frame::Label::kGround : frame::Label::kOtherGround;
    EXPECT_EQ(labels[extra.return_index], expected) << extra.point.y_m;
  }
}

TEST_F(RoadSurfaceOfAFrame, AnEmptyFrameAndOneOfAFewColumnsAreNoTrouble) {
  EXPECT_TRUE(segment([](double, double) { return -1.0; }).empty());
  for (const int columns : {3, 7, 40}) {
    const frame::ImageShape shape{64, columns};
    frame::RangeImage small(shape, 0, memory);
    ground::Segmenter of_small(config, profile, shape, small.return_capacity(), memory);
    test::cast_frame(profile, street(0), small);
    EXPECT_EQ(of_small.segment(small).returns, small.returns());
  }
}

}  // namespace
}  // namespace terracut::road
