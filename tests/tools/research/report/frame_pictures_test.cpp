// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/report/frame_pictures.hpp"

#include <gmock/gmock.h>

#include "tests/tools/research/eval/made_up_dataset.hpp"
#include "tools/research/datasets/built_in_tables.hpp"

namespace terracut::report {
namespace {

using frame::Label;
using pictures::Colour;
using pictures::Picture;
using testing::HasSubstr;

std::size_t pixels_of(const Picture& picture, Colour colour) {
  std::size_t count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) count += picture.at(x, y) == colour ? 1 : 0;
  }
  return count;
}

class FramePicturesTest : public testing::Test {
 protected:
  /// With a method that finds no road, and one that calls everything ground.
  [[nodiscard]] static eval::EvaluationConfig config_of(const eval::MadeUpDataset& dataset) {
    eval::EvaluationConfig config;
    config.layout = *datasets::built_in_table("semantickitti")->layout();
    config.root = dataset.root();
    config.methods = {*eval::method_named("terracut"), *eval::method_named("terracut_road"),
                      *eval::method_named("ring_map")};
    eval::MethodChoice& roadless = config.methods[1];
    roadless.name = "roadless";
    roadless.config.segmenter.road.vehicle_width_m = 100;
    eval::MethodChoice& blind = config.methods.back();
    blind.name = "blind";
    blind.config.segmenter.elevation_map.obstacle_height_m = 1000;
    return config;
  }

  eval::MadeUpDataset dataset_;
  eval::EvaluationConfig config_ = config_of(dataset_);
  datasets::ClassTable classes_ = *datasets::built_in_table("semantickitti");
  datasets::Dataset files_ = datasets::Dataset::at(config_.layout, config_.root).value();
  FrameReader reader_{files_, config_.mount, classes_};
  FramePictures pictures_{config_, reader_};
  pictures::BirdEyeView view_{.side_m = 40, .pixels_per_m = 8};
};

TEST(Verdict, SaysWhatBecameOfAReturn) {
  EXPECT_EQ(verdict_of(datasets::Role::kGround, Label::kGround), Verdict::kGround);
  EXPECT_EQ(verdict_of(datasets::Role::kGround, Label::kOtherGround), Verdict::kOtherGround);
  EXPECT_EQ(verdict_of(datasets::Role::kGround, Label::kObstacle), Verdict::kFalseObstacle);
  EXPECT_EQ(verdict_of(datasets::Role::kKeyObstacle, Label::kGround), Verdict::kMissedKey);
  EXPECT_EQ(verdict_of(datasets::Role::kOrdinaryObstacle, Label::kGround),
            Verdict::kMissedOrdinary);
  EXPECT_EQ(verdict_of(datasets::Role::kOrdinaryObstacle, Label::kOtherGround),
            Verdict::kMissedOrdinary);
  EXPECT_EQ(verdict_of(datasets::Role::kKeyObstacle, Label::kObstacle), Verdict::kObstacle);
  EXPECT_EQ(verdict_of(datasets::Role::kIgnored, Label::kGround), Verdict::kIgnored);
}

TEST_F(FramePicturesTest, ShowTheTruthInItsColours) {
  ASSERT_TRUE(pictures_.open("00", "000001"));
  const Picture truth = pictures_.truth(view_, false);
  for (const datasets::Role role :
       {datasets::Role::kGround, datasets::Role::kOrdinaryObstacle, datasets::Role::kKeyObstacle}) {
    EXPECT_GT(pixels_of(truth, colour_of(role)), 50U) << static_cast<int>(role);
  }
}

TEST_F(FramePicturesTest, ShowTheRoadApartWhereAskedTo) {
  // In the made-up frames ground is road beyond 8 m, terrain nearer.
  ASSERT_TRUE(pictures_.open("00", "000001"));
  const Picture without = pictures_.truth(view_, false), with = pictures_.truth(view_, true);
  EXPECT_EQ(pixels_of(without, kTrueRoadColour), 0U);
  EXPECT_GT(pixels_of(with, kTrueRoadColour), 50U);
  EXPECT_GT(pixels_of(with, colour_of(datasets::Role::kGround)), 50U);
  EXPECT_LT(pixels_of(with, colour_of(datasets::Role::kGround)),
            pixels_of(without, colour_of(datasets::Role::kGround)));
}

TEST_F(FramePicturesTest, ShowOtherGroundApartWhereAMethodTellsIt) {
  ASSERT_TRUE(pictures_.open("00", "000001"));
  const Colour other = colour_of(Verdict::kOtherGround);
  EXPECT_EQ(pixels_of(pictures_.result("terracut", view_), other), 0U);
  EXPECT_GT(pixels_of(pictures_.result("roadless", view_), other), 100U);
}

TEST_F(FramePicturesTest, ShowWhatWasMissedInRed) {
  ASSERT_TRUE(pictures_.open("00", "000001"));
  const Colour red = colour_of(Verdict::kMissedKey), orange = colour_of(Verdict::kMissedOrdinary);
  const Picture good = pictures_.result("terracut", view_), bad = pictures_.result("blind", view_);
  EXPECT_GT(pixels_of(bad, red), 30U);
  EXPECT_GT(pixels_of(bad, orange), 100U);
  EXPECT_EQ(pixels_of(bad, colour_of(Verdict::kObstacle)), 0U);
  EXPECT_LT(pixels_of(good, red), pixels_of(bad, red) / 10);
  EXPECT_GT(pixels_of(good, colour_of(Verdict::kObstacle)), 100U);
  EXPECT_GT(pixels_of(pictures_.panorama("blind"), pictures::kMissedObstacleColour), 1000U);
}

TEST_F(FramePicturesTest, MarkMissedKeyObstaclesAndHaveThemInView) {
  ASSERT_TRUE(pictures_.open("00", "000001"));
  const auto view = pictures_.view_of_misses("blind", 480);
  EXPECT_EQ(view.side_m, 60);  // cars are within 5 m
  const Picture marked = pictures_.marked_result("blind", view);
  EXPECT_EQ(marked.width(), 480);
  const auto reddish = [](const Picture& picture) {
    std::size_t count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const Colour colour = picture.at(x, y);
        count += colour.red > 180 && colour.green < 80 ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_GT(reddish(marked), reddish(pictures_.result("blind", view)) + 100);
}

TEST_F(FramePicturesTest, GoFromSequenceToSequence) {
  ASSERT_TRUE(pictures_.open("00", "000000"));
  const auto first = pictures_.truth(view_, false).png().value();
  ASSERT_TRUE(pictures_.open("03", "000002"));
  EXPECT_NE(pictures_.truth(view_, false).png().value(), first);
  ASSERT_TRUE(pictures_.open("00", "000000"));
  EXPECT_EQ(pictures_.truth(view_, false).png().value(), first);
}

TEST_F(FramePicturesTest, NameFramesThatCannotBeRead) {
  dataset_.write(dataset_.points("00", 1), "torn");
  const auto torn = pictures_.open("00", "000001");
  ASSERT_FALSE(torn);
  EXPECT_THAT(torn.error().message, HasSubstr("000001.bin"));
  const auto missing = pictures_.open("00", "000017");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("00/000017"));
  EXPECT_FALSE(pictures_.open("17", "000000"));
  EXPECT_TRUE(pictures_.open("00", "000002"));
}

}  // namespace
}  // namespace terracut::report
