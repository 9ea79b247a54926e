// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/coarse_stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/synthetic_turn.hpp"

namespace terracut::pipeline {
namespace {

const ImageShape kShape{64, 960};  // no padding, and whole blocks of sectors
constexpr int kPacket = 6;         // columns
constexpr std::size_t kOverflow = 2000;

/// Walls of all kinds around the vehicle, roofs in a row among them, on hilly ground; some beams
/// come back from nowhere.
test::BeamCast hills_and_walls() {
  return [](double azimuth_rad, double elevation_rad) {
    if (std::sin(37 * azimuth_rad + 91 * elevation_rad) > 0.97) return -1.0;
    const double wall_m = 9 + 4 * std::sin(7 * azimuth_rad) + 2 * std::sin(31 * azimuth_rad);
    const double wall_top_m = 0.4 + 0.9 * std::fabs(std::sin(11 * azimuth_rad));
    const double slope = 0.12 * std::sin(3 * azimuth_rad);
    const double down = -std::sin(elevation_rad) + slope * std::cos(elevation_rad);
    const double ground_m = down > 0.004 ? 1.73 / down : -1;
    const double hit_z_m = 1.73 + wall_m * std::tan(elevation_rad);
    const bool hits = std::sin(5 * azimuth_rad) > -0.2 && hit_z_m < wall_top_m + slope * wall_m &&
                      (ground_m < 0 || wall_m < ground_m);
    return hits ? wall_m / std::cos(elevation_rad) : ground_m;
  };
}

/// One way through the coarse stages, with all its memory.
struct Way {
  explicit Way(const SegmenterConfig& config)
      : planes(kShape, memory), stages(config, profile, kShape, memory) {}

  /// Bits, so that NaN equals NaN.
  [[nodiscard]] std::vector<std::uint32_t> result() const {
    std::vector<std::uint32_t> bits;
    for (const float height_m : planes.height_m)
      bits.push_back(std::bit_cast<std::uint32_t>(height_m));
    for (const Label label : planes.label) bits.push_back(static_cast<std::uint32_t>(label));
    for (const std::uint8_t steep : planes.steep) bits.push_back(steep);
    return bits;
  }

  rt::FixedMemory memory;
  calib::RingProfile profile = test::even_profile();
  CellPlanes planes;
  CoarseStages stages;
};

/// A turn whose columns arrive one after the other.
struct ArrivingColumns {
  explicit ArrivingColumns(const test::BeamCast& cast)
      : whole(kShape, 0, memory), image(kShape, kOverflow, memory) {
    test::cast_turn(test::even_profile(), cast, whole);
    image.clear();
  }
  void place(int column) {
    for (int row = 0; row < kShape.rows; ++row) place(row, column);
  }
  void place(int row, int column) {
    const std::size_t cell = kShape.cell(row, column);
    if (!whole.has_return(cell)) return;
    ASSERT_TRUE(image.place(row, column,
                            {whole.x_m()[cell], whole.y_m()[cell], whole.z_m()[cell],
                             whole.ground_range_m()[cell], 0}));
  }
  rt::FixedMemory memory;
  RangeImage whole;
  RangeImage image;
};

struct Recorder : StageObserver {
  void stage_done(Stage stage) noexcept override {
    ++parts;
    last = stage;
  }
  int parts = 0;
  Stage last = Stage::kCount;
};

struct CoarseStagesOfArrivingTurns : testing::TestWithParam<const char*> {
  static SegmenterConfig config() {
    return std::string_view(GetParam()) == "paper" ? paper_profile() : terracut_profile();
  }
  /// What the stages make of the image as it is now, nothing done ahead.
  static std::vector<std::uint32_t> at_once(const RangeImage& image) {
    Way way(config());
    way.stages.finish(image, way.planes);
    return way.result();
  }
  /// Lets the turn arrive; `meanwhile(column)` is called after each packet.
  template <class Meanwhile>
  void arrive(ArrivingColumns& turn, Meanwhile meanwhile) {
    for (int column = 0; column < kShape.columns; ++column) {
      turn.place(column);
      if ((column + 1) % kPacket != 0) continue;
      way.stages.advance(turn.image, column + 1, way.planes, &recorder);
      meanwhile(column);
    }
  }
  void arrive(ArrivingColumns& turn) {
    arrive(turn, [](int) {});
  }
  Way way{config()};
  Recorder recorder;
};

TEST_P(CoarseStagesOfArrivingTurns, LabelAsIfTheTurnHadComeAtOnce) {
  ArrivingColumns turn(hills_and_walls());
  arrive(turn);
  EXPECT_GT(recorder.parts, 6) << "some of it is done ahead";
  way.stages.finish(turn.image, way.planes);
  EXPECT_EQ(way.result(), at_once(turn.image));
  EXPECT_GT(std::ranges::count(way.planes.label, Label::kObstacle), 1000);
  EXPECT_GT(std::ranges::count(way.planes.label, Label::kGround), 1000);
}

TEST_P(CoarseStagesOfArrivingTurns, LabelAsIfAtOnceHoweverFarTheTurnHadCome) {
  ArrivingColumns turn(hills_and_walls());
  for (int column = 0; column < kShape.columns; ++column) turn.place(column);
  const auto expected = at_once(turn.image);
  for (const int settled : {0, 1, 159, 160, 161, 320, 500, 777, 950, 959, 960}) {
    way.stages.advance(turn.image, settled, way.planes);
    way.stages.finish(turn.image, way.planes);
    EXPECT_EQ(way.result(), expected) << settled << " columns settled";
  }
}

TEST_P(CoarseStagesOfArrivingTurns, LabelAnythingAsIfAtOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  for (int trial = 0; trial < 5; ++trial) {
    ArrivingColumns turn([&](double, double) { return range_m(random); });
    arrive(turn);
    way.stages.finish(turn.image, way.planes);
    EXPECT_EQ(way.result(), at_once(turn.image));
  }
}

TEST_P(CoarseStagesOfArrivingTurns, TakeAReturnThatComesAfterItsColumnWasDone) {
  ArrivingColumns turn(hills_and_walls());
  const std::size_t late = kShape.cell(20, 100);
  ASSERT_TRUE(turn.whole.has_return(late));
  for (int column = 0; column < kShape.columns; ++column) {
    for (int row = 0; row < kShape.rows; ++row) {
      if (kShape.cell(row, column) != late) turn.place(row, column);
    }
    way.stages.advance(turn.image, column + 1, way.planes, &recorder);
    if (column == 800) turn.place(20, 100);
  }
  way.stages.finish(turn.image, way.planes);
  EXPECT_EQ(way.result(), at_once(turn.image));
}

TEST_P(CoarseStagesOfArrivingTurns, TakeASecondEchoThatComesAfterItsColumnWasDone) {
  for (const CellOwner owner : {CellOwner::kFirstArrived, CellOwner::kNearest}) {
    ArrivingColumns turn(hills_and_walls());
    arrive(turn, [&](int column) {
      if (column != 803) return;
      const std::size_t cell = kShape.cell(20, 100);
      ASSERT_TRUE(turn.image.has_return(cell));
      // Lower and nearer than what is there: it changes the ground of its sector.
      const float share = 0.5F;
      ASSERT_TRUE(turn.image.place(
          20, 100,
          {share * turn.image.x_m()[cell], share * turn.image.y_m()[cell],
           turn.image.z_m()[cell] - 0.3F, share * turn.image.ground_range_m()[cell], 0},
          owner));
    });
    way.stages.finish(turn.image, way.planes);
    EXPECT_EQ(way.result(), at_once(turn.image));
  }
}

TEST_P(CoarseStagesOfArrivingTurns, TakeSecondEchoesInTheirOwnTime) {
  ArrivingColumns turn(hills_and_walls());
  int echoes = 0;
  for (int column = 0; column < kShape.columns; ++column) {
    turn.place(column);
    for (int row = 3; row < 40; row += 20) {
      const std::size_t cell = kShape.cell(row, column);
      if (!turn.image.has_return(cell)) continue;
      ASSERT_TRUE(
          turn.image.place(row, column,
                           {turn.image.x_m()[cell], turn.image.y_m()[cell],
                            turn.image.z_m()[cell] - 0.4F, turn.image.ground_range_m()[cell], 0}));
      ++echoes;
    }
    way.stages.advance(turn.image, column + 1, way.planes, &recorder);
  }
  EXPECT_GT(echoes, 500);
  const int ahead = recorder.parts;
  way.stages.finish(turn.image, way.planes, &recorder);
  EXPECT_LT(recorder.parts - ahead, ahead) << "most was done ahead, not again";
  EXPECT_EQ(way.result(), at_once(turn.image));
}

TEST_P(CoarseStagesOfArrivingTurns, ForgetATurnThatNeverBecameWhole) {
  ArrivingColumns first(hills_and_walls()), second(test::ground_with_wall(12, 4, 2.0));
  arrive(first);
  arrive(second);
  way.stages.finish(second.image, way.planes);
  EXPECT_EQ(way.result(), at_once(second.image));

  way.stages.advance(first.image, 900, way.planes);
  first.image.clear();  // its next turn
  for (int column = 0; column < 700; ++column) first.place(column);
  way.stages.advance(first.image, 600, way.planes);
  way.stages.finish(first.image, way.planes);
  EXPECT_EQ(way.result(), at_once(first.image));
}

TEST_P(CoarseStagesOfArrivingTurns, DoNothingForATurnWithoutReturns) {
  ArrivingColumns turn([](double, double) { return -1.0; });
  arrive(turn);
  EXPECT_EQ(recorder.parts, 0);
  way.stages.finish(turn.image, way.planes);
  EXPECT_EQ(way.result(), at_once(turn.image));
}

TEST_P(CoarseStagesOfArrivingTurns, AllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  ArrivingColumns turn(hills_and_walls());
  const std::uint64_t before = test::allocations_of_this_thread();
  arrive(turn);
  way.stages.finish(turn.image, way.planes);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

INSTANTIATE_TEST_SUITE_P(BothProfiles, CoarseStagesOfArrivingTurns,
                         testing::Values("terracut", "paper"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace terracut::pipeline
