// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/stream_segmenter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "pipeline/ground/segmenter.hpp"
#include "tests/firmware_io/frame/plain_tiles.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::ground {
namespace {

constexpr frame::ImageShape kShape{64, 960};
constexpr auto kLasers = static_cast<std::size_t>(kShape.rows);
constexpr int kTile = int{frame::kTileFirings};

/// Reads tiles of images: a firing is a column, a wire distance says whether there is a return.
class ImageReader final : public test::HeldTileReader<kLasers> {
 public:
  explicit ImageReader(const frame::RangeImage& image) : HeldTileReader({}) {
    std::iota(rows_.begin(), rows_.end(), 0);
    show(image);
  }
  void show(const frame::RangeImage& image) { image_ = &image; }

  void compute_points(std::size_t laser,
                      const frame::PointsOut& out) noexcept TERRACUT_NONBLOCKING override {
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      const std::size_t cell = kShape.cell(rows_[laser], heads_.head_cdeg[f]);
      out.x_m[f] = image_->x_m()[cell];
      out.y_m[f] = image_->y_m()[cell];
      out.ground_range_m[f] = image_->ground_range_m()[cell];
      out.z_m[f] = raw(laser, f) == 0 ? frame::kNoHeight_m : image_->z_m()[cell];
    }
  }

 private:
  const frame::RangeImage* image_;
};

/// Ground as rough as grass, with low walls: thousands of unknown cells, alone and together.
test::BeamCast rough_ground(std::mt19937& random) {
  return [&random](double azimuth_rad, double elevation_rad) {
    const double wall_m = 10 + 3 * std::sin(9 * azimuth_rad);
    const double bump_m = std::uniform_real_distribution<double>(-0.1, 0.1)(random);
    const double height_m = 1.73 - std::fabs(bump_m) * (1 + std::sin(2 * azimuth_rad));
    const double range_m = elevation_rad < 0 ? height_m / std::tan(-elevation_rad) : 1e9;
    const double hit_z_m = 1.73 + wall_m * std::tan(elevation_rad);
    const bool hits = std::sin(5 * azimuth_rad) > 0 && range_m > wall_m && hit_z_m < 0.4;
    return (hits ? wall_m : range_m) / std::cos(elevation_rad);
  };
}

class StreamSegmenterOnTurns : public testing::Test {
 protected:
  void begin(const SegmenterConfig& config = terracut_profile(), Pace pace = Pace::kLatency) {
    memory_.emplace();
    segmenter_ = std::make_unique<StreamSegmenter>(config, pace, profile_, kShape, kShape.cells(),
                                                   std::make_unique<ImageReader>(image_), *memory_);
  }
  void cast(const test::BeamCast& cast) { test::cast_frame(profile_, cast, image_); }

  /// Returns the next of three turns, empty.
  frame::MeasuredReturns& next_turn(std::int64_t skipped = 0) {
    number_ += 1 + skipped;
    frame::MeasuredReturns& turn = turns_[static_cast<std::size_t>(number_) % turns_.size()];
    turn.clear(number_);
    return turn;
  }
  /// Adds the image's returns in a tile of columns from `first` on, except those of `without`.
  void add_tile(frame::MeasuredReturns& turn, int first, std::size_t without = kShape.cells(),
                bool only = false) {
    std::array<frame::TileRow<std::uint16_t>, kLasers> raw{};
    std::array<frame::TileRow<std::uint8_t>, kLasers> intensity{};
    std::array<frame::BeamColumns, kLasers> beams{};
    frame::TileHeads heads{};
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      heads.head_cdeg[f] = first + static_cast<std::int32_t>(f);
    }
    for (std::size_t i = 0; i < kLasers; ++i) {
      beams[i].column = heads.head_cdeg;
      beams[i].least = first;
      beams[i].most = first + kTile - 1;
      beams[i].is_one_run = true;
      for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
        const std::size_t cell = kShape.cell(static_cast<int>(i), heads.head_cdeg[f]);
        raw[i][f] = image_.has_return(cell) && (cell == without) == only;
      }
    }
    ASSERT_EQ(turn.add({.heads = heads,
                        .distances = {raw[0].data()},
                        .intensity = intensity[0].data(),
                        .beams = beams,
                        .first_column = 0},
                       frame::CellOwner::kFirstArrived, reader_),
              0U);
  }
  /// The labels of the image by itself, in the order of a turn's returns.
  std::vector<frame::Label> closed_labels(const SegmenterConfig& config = terracut_profile()) {
    memory::FixedMemory memory;
    Segmenter segmenter(config, profile_, kShape, image_.return_capacity(), memory);
    (void)segmenter.segment(image_);
    std::vector<frame::Label> labels;
    for (int column = 0; column < kShape.columns; ++column) {
      for (int row = 0; row < kShape.rows; ++row) {
        const std::size_t cell = kShape.cell(row, column);
        if (image_.has_return(cell)) labels.push_back(segmenter.planes().label[cell]);
      }
    }
    return labels;
  }
  /// Lets the image come as a turn; labels of turns that are whole are kept.
  void arrive(std::mt19937& random, std::int64_t skipped = 0) {
    frame::MeasuredReturns& turn = next_turn(skipped);
    for (int column = 0; column < kShape.columns; column += kTile) {
      add_tile(turn, column);
      if (random() % 3U != 0) continue;
      segmenter_->advance(turn, column + kTile, {}, nullptr);
      take_labels();
    }
    segmenter_->end_turn(turn, {}, nullptr);
    take_labels();
  }
  void take_labels() {
    while (const frame::MeasuredReturns* turn = segmenter_->labelled()) {
      labelled_.emplace_back(turn->turn(), std::vector<frame::Label>(segmenter_->labels().begin(),
                                                                     segmenter_->labels().end()));
      EXPECT_EQ(segmenter_->labels().size(), turn->returns());
      EXPECT_EQ(std::ranges::count(segmenter_->labels(), frame::Label::kNone), 0);
      reports_.push_back(segmenter_->report());
      heights_m_.assign(segmenter_->heights_m().begin(), segmenter_->heights_m().end());
      segmenter_->release();
    }
  }

  mount::RingProfile profile_ = test::even_profile();
  memory::FixedMemory memory_of_test_;
  frame::RangeImage image_{kShape, 0, memory_of_test_};
  ImageReader reader_{image_};
  std::vector<frame::MeasuredReturns> turns_{
      frame::MeasuredReturns(kShape, kLasers, 50, memory_of_test_),
      frame::MeasuredReturns(kShape, kLasers, 50, memory_of_test_),
      frame::MeasuredReturns(kShape, kLasers, 50, memory_of_test_)};
  std::int64_t number_ = 0;
  std::optional<memory::FixedMemory> memory_;
  std::unique_ptr<StreamSegmenter> segmenter_;
  std::vector<std::pair<std::int64_t, std::vector<frame::Label>>> labelled_;
  std::vector<stage::SegmentationReport> reports_;
  std::vector<float> heights_m_;  // of the turn labelled last
};

TEST_F(StreamSegmenterOnTurns, OfAStillWorldHaveTheLabelsOfOneTurnClosedWithItself) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 8; ++trial) {
    SCOPED_TRACE(trial);
    begin();
    cast(rough_ground(random));
    const std::vector<frame::Label> expected = closed_labels();
    labelled_.clear();
    reports_.clear();
    for (int turn = 0; turn < 4; ++turn) arrive(random);
    EXPECT_EQ(labelled_.size(), 3U) << "the fourth waits for what follows it";
    segmenter_->close({}, nullptr);
    take_labels();
    ASSERT_EQ(labelled_.size(), 4U);
    std::size_t differ = 0, returns = 0;
    std::uint32_t cut_open = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_EQ(labelled_[i].second.size(), expected.size());
      for (std::size_t n = 0; n < expected.size(); ++n) {
        differ += labelled_[i].second[n] != expected[n];
      }
      returns += expected.size();
      cut_open += reports_[i].cut.cut_open;
      EXPECT_EQ(reports_[i].late, 0U);
      EXPECT_GT(reports_[i].cut.unknown, 1500U);
    }
    EXPECT_EQ(labelled_[0].second, expected) << "a turn that follows none is closed with itself";
    EXPECT_LE(differ, cut_open + 50) << "at the seams of the first turn and the last";
    EXPECT_LT(differ, returns / 1000);
  }
}

TEST_F(StreamSegmenterOnTurns, HaveTheSameLabelsWhateverWasThereOfThemWhenWorkWasDone) {
  std::mt19937 random(8);
  std::vector<std::vector<frame::Label>> first;
  for (int trial = 0; trial < 4; ++trial) {
    begin(terracut_profile(), trial % 2 == 0 ? Pace::kLatency : Pace::kThroughput);
    labelled_.clear();
    std::mt19937 of_world(5);
    for (int turn = 0; turn < 4; ++turn) {
      cast(rough_ground(of_world));
      arrive(random);
    }
    segmenter_->close({}, nullptr);
    take_labels();
    ASSERT_EQ(labelled_.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      if (trial == 0) first.push_back(labelled_[i].second);
      EXPECT_EQ(labelled_[i].second, first[i]) << i;
    }
  }
}

TEST_F(StreamSegmenterOnTurns, AreEachLabelledByItselfWhereTheMethodNeedsAWholeTurn) {
  std::mt19937 random(9);
  begin(paper_profile());
  EXPECT_FALSE(segmenter_->can_go_on());
  for (int turn = 0; turn < 3; ++turn) {
    cast(rough_ground(random));
    const std::vector<frame::Label> expected = closed_labels(paper_profile());
    arrive(random);
    ASSERT_EQ(labelled_.size(), static_cast<std::size_t>(turn) + 1);
    EXPECT_EQ(labelled_.back().second, expected);
  }
}

TEST_F(StreamSegmenterOnTurns, AreLabelledInOrderWhereTheStreamBreaksOff) {
  std::mt19937 random(10);
  begin();
  cast(rough_ground(random));
  arrive(random);
  arrive(random);
  EXPECT_EQ(labelled_.size(), 1U);
  cast(rough_ground(random));
  const std::vector<frame::Label> expected = closed_labels();
  arrive(random, 6);
  ASSERT_EQ(labelled_.size(), 3U) << "it is closed by the one that does not follow it";
  EXPECT_EQ(labelled_[1].first, 2);
  EXPECT_EQ(labelled_[2].first, 9);
  EXPECT_EQ(labelled_[2].second, expected) << "which knows nothing of it";
}

TEST_F(StreamSegmenterOnTurns, GoOnAfterATurnThatWasClosedBecauseTheNextOneCameLate) {
  std::mt19937 random(11);
  begin();
  cast(rough_ground(random));
  arrive(random);
  arrive(random);
  segmenter_->close({}, nullptr);
  take_labels();
  EXPECT_EQ(labelled_.size(), 2U);
  arrive(random);
  EXPECT_EQ(labelled_.size(), 2U);
  segmenter_->close({}, nullptr);
  take_labels();
  EXPECT_EQ(labelled_.size(), 3U);
  segmenter_->close({}, nullptr);
  take_labels();
  EXPECT_EQ(labelled_.size(), 3U);
}

TEST_F(StreamSegmenterOnTurns, AreLabelledThoughTheNextOneBreaksOffAtItsBeginning) {
  std::mt19937 random(11);
  begin();
  cast(rough_ground(random));
  const std::vector<frame::Label> expected = closed_labels();
  arrive(random);
  arrive(random);
  frame::MeasuredReturns& turn = next_turn();
  for (int column = 0; column < kShape.columns; column += kTile) {
    add_tile(turn, column);
    segmenter_->advance(turn, column + kTile, {}, nullptr);
    if (column != 2 * kTile) continue;
    EXPECT_EQ(segmenter_->labelled(), nullptr);
    segmenter_->close({}, nullptr);  // it is waited for no longer
    take_labels();
    EXPECT_EQ(labelled_.size(), 2U);
  }
  segmenter_->end_turn(turn, {}, nullptr);  // but it goes on
  segmenter_->close({}, nullptr);
  take_labels();
  ASSERT_EQ(labelled_.size(), 3U);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) differ += labelled_[2].second[i] != expected[i];
  EXPECT_LT(differ, expected.size() / 1000);
}

TEST_F(StreamSegmenterOnTurns, AReturnThatComesLateIsJudgedByItsHeightAndCounted) {
  std::mt19937 random(12);
  begin();
  cast(test::ground_with_wall(12, 4, 2.0));
  arrive(random);
  const std::vector<frame::Label> expected = closed_labels();
  for (const int row : {10, 40}) {
    std::size_t late = kShape.cell(row, 100);
    while (!image_.has_return(late)) ++late;
    frame::MeasuredReturns& turn = next_turn();
    for (int column = 0; column < kShape.columns; column += kTile) {
      add_tile(turn, column, late);
      segmenter_->advance(turn, column + kTile, {}, nullptr);
      take_labels();
      if (column == 30 * kTile) add_tile(turn, 96, late, true);
    }
    segmenter_->end_turn(turn, {}, nullptr);
    segmenter_->close({}, nullptr);
    take_labels();
    EXPECT_EQ(reports_.back().late, 1U);
    EXPECT_EQ(labelled_.back().second.size(), expected.size());
    const auto count = [](const std::vector<frame::Label>& labels) {
      return std::ranges::count(labels, frame::Label::kObstacle);
    };
    EXPECT_EQ(count(labelled_.back().second), count(expected)) << "row " << row;
  }
}

SegmenterConfig with_heights() {
  SegmenterConfig config = terracut_profile();
  config.gives_heights = true;
  return config;
}

TEST_F(StreamSegmenterOnTurns, HaveAHeightAboveTheGroundBesideEachLabel) {
  std::mt19937 random(15);
  begin(with_heights());
  cast(test::ground_with_wall(12, 4, 2.0));
  for (int turn = 0; turn < 3; ++turn) arrive(random);
  ASSERT_EQ(labelled_.size(), 2U);
  ASSERT_EQ(heights_m_.size(), labelled_.back().second.size());
  std::size_t n = 0;
  float worst_m = 0;
  for (int column = 0; column < kShape.columns; ++column) {
    for (int row = 0; row < kShape.rows; ++row) {
      const std::size_t cell = kShape.cell(row, column);
      if (!image_.has_return(cell)) continue;
      worst_m = std::max(worst_m, std::fabs(heights_m_[n++] - image_.z_m()[cell]));
    }
  }
  EXPECT_EQ(n, heights_m_.size());
  EXPECT_LT(worst_m, 0.03F);
}

TEST_F(StreamSegmenterOnTurns, HaveTheSameLabelsWithHeightsAndNoHeightsUnlessAskedFor) {
  std::vector<std::vector<frame::Label>> labels;
  std::vector<float> heights_m;
  for (const SegmenterConfig& config : {terracut_profile(), with_heights(), with_heights()}) {
    begin(config);
    labelled_.clear();
    std::mt19937 of_world(16);
    cast(rough_ground(of_world));
    for (int turn = 0; turn < 3; ++turn) arrive(of_world);
    labels.push_back(labelled_.back().second);
    EXPECT_EQ(heights_m_.empty(), !config.gives_heights);
    if (!heights_m.empty()) {
      EXPECT_EQ(heights_m_, heights_m);
    }
    heights_m = heights_m_;
  }
  EXPECT_EQ(labels[1], labels[0]);
}

TEST_F(StreamSegmenterOnTurns, AReturnThatComesLateHasItsHeight) {
  std::mt19937 random(17);
  begin(with_heights());
  cast(test::ground_with_wall(12, 4, 2.0));
  arrive(random);
  std::size_t late = kShape.cell(10, 100);
  while (!image_.has_return(late)) ++late;
  frame::MeasuredReturns& turn = next_turn();
  for (int column = 0; column < kShape.columns; column += kTile) {
    add_tile(turn, column, late);
    segmenter_->advance(turn, column + kTile, {}, nullptr);
    take_labels();
    if (column == 30 * kTile) add_tile(turn, 96, late, true);
  }
  segmenter_->end_turn(turn, {}, nullptr);
  segmenter_->close({}, nullptr);
  take_labels();
  EXPECT_EQ(reports_.back().late, 1U);
  EXPECT_EQ(std::ranges::count_if(heights_m_, [](float h) { return !std::isfinite(h); }), 0);
}

TEST_F(StreamSegmenterOnTurns, KeepTheirCoarseLabelsWhereTheBudgetHasExpired) {
  std::mt19937 random(13);
  begin();
  cast(rough_ground(random));
  const min_cut::CutBudget expired{
      .expired = [](void*) noexcept TERRACUT_NONBLOCKING { return true; }};
  for (int i = 0; i < 2; ++i) {
    frame::MeasuredReturns& turn = next_turn();
    for (int column = 0; column < kShape.columns; column += kTile) add_tile(turn, column);
    segmenter_->end_turn(turn, expired, nullptr);
  }
  segmenter_->close(expired, nullptr);
  take_labels();
  ASSERT_EQ(reports_.size(), 2U);
  for (const stage::SegmentationReport& report : reports_) {
    EXPECT_EQ(report.last_stage, stage::Stage::kAdjacentPoints);
    EXPECT_EQ(report.cut.coarse_by_budget, report.cut.unknown);
  }
  SegmenterConfig coarse = terracut_profile();
  coarse.last_stage = stage::Stage::kAdjacentPoints;
  EXPECT_EQ(labelled_[0].second, closed_labels(coarse));
}

TEST_F(StreamSegmenterOnTurns, AllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  std::mt19937 random(14);
  begin(with_heights());
  cast(rough_ground(random));
  arrive(random);
  frame::MeasuredReturns& turn = next_turn();
  for (int column = 0; column < kShape.columns; column += kTile) add_tile(turn, column);
  const std::uint64_t before = test::allocations_of_this_thread();
  segmenter_->advance(turn, 500, {}, nullptr);
  segmenter_->end_turn(turn, {}, nullptr);
  segmenter_->close({}, nullptr);
  segmenter_->release();
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

}  // namespace
}  // namespace terracut::ground
