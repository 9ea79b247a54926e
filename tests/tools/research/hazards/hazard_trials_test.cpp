// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/hazard_trials.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "flat_scene.hpp"
#include "tools/research/hazards/hazard_report.hpp"

namespace terracut::hazards {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class HazardTrialsTest : public testing::Test {
 protected:
  static HazardChoice choice_of(const std::vector<std::string>& words, std::uint64_t seed = 1) {
    HazardChoice choice;
    EXPECT_TRUE(choose(words, choice));
    choice.seed = seed;
    return choice;
  }
  void look(HazardTrials& trials, const std::string& frame) const {
    static const std::string kSequence = "00";
    trials.look({kSequence, frame, scene_.image, scene_.profile, scene_.truth, {}, {}});
  }
  [[nodiscard]] std::string report(const HazardChoice& choice,
                                   const std::vector<std::string>& frames) const {
    HazardTrials trials(methods_, scene_.classes, choice);
    for (const std::string& frame : frames) look(trials, frame);
    return hazard_json(trials, 0).dump() + hazard_json(trials, 1).dump();
  }

  FlatScene scene_;
  /// The first calls ground whatever is below 2 m; to the second everything above 1 cm is an
  /// obstacle.
  const std::vector<eval::MethodChoice> methods_{
      *eval::method_variant("blind=ring_map,elevation_map.obstacle_height_m=2", {}),
      *eval::method_variant("sharp=ring_map,elevation_map.obstacle_height_m=0.01", {})};
};

TEST_F(HazardTrialsTest, CountWhatABlindMethodMissesAndASharpOneFinds) {
  HazardTrials trials(methods_, scene_.classes, choice_of({"lying_person", "box_20cm"}));
  look(trials, "000000");
  const auto blind = hazard_json(trials, 0).at("hazards");
  const auto sharp = hazard_json(trials, 1).at("hazards");
  ASSERT_GE(blind.size(), 2U * 3U * 3U);
  ASSERT_EQ(blind.size(), sharp.size());
  for (const auto& entry : blind) {
    EXPECT_EQ(entry.at("trials"), 1);
    EXPECT_EQ(entry.at("found"), 0);
    EXPECT_EQ(entry.at("unseen"), 1);
    EXPECT_GE(entry.at("returns"), kFewestReturns);
    EXPECT_EQ(entry.at("returns_as_obstacle"), 0);
    EXPECT_EQ(entry.at("elsewhere").at("iou_g").at("after"), 1);
    EXPECT_TRUE(entry.at("elsewhere").at("recall_o").at("after").is_null()) << "no obstacle here";
  }
  for (const auto& entry : sharp) {
    EXPECT_EQ(entry.at("found"), 1) << entry;
    EXPECT_EQ(entry.at("unseen"), 0);
  }
  EXPECT_THAT(
      hazard_text("blind", hazard_json(trials, 0)),
      AllOf(HasSubstr("lying_person"), HasSubstr("sidewalk"), HasSubstr("   0 100   0 (1)")));
}

TEST_F(HazardTrialsTest, CountWhatADisturbanceCostsElsewhere) {
  HazardTrials trials(methods_, scene_.classes, choice_of({"ghosts_5", "dirt"}));
  look(trials, "000000");
  const auto sharp = hazard_json(trials, 1);
  EXPECT_TRUE(sharp.at("hazards").empty());
  ASSERT_EQ(sharp.at("disturbances").size(), 2U);
  const auto& ghosts = sharp.at("disturbances")[0];
  EXPECT_EQ(ghosts.at("disturbance"), "ghosts_5");
  EXPECT_EQ(ghosts.at("elsewhere").at("iou_g").at("before"), 1);
  EXPECT_LT(ghosts.at("elsewhere").at("iou_g").at("after"), 1) << "cells have their lowest return";
}

TEST_F(HazardTrialsTest, FollowFromTheSeedAndNotFromTheOrderOfFrames) {
  const std::vector<std::string> words{"child", "branch", "kerb_stone", "snow_10"};
  const std::string once = report(choice_of(words, 1), {"000000", "000001"});
  EXPECT_EQ(report(choice_of(words, 1), {"000001", "000000"}), once);
  EXPECT_NE(report(choice_of(words, 2), {"000000", "000001"}), once);
}

TEST_F(HazardTrialsTest, PutNothingWhereNoGroundIsLabelled) {
  std::ranges::fill(scene_.truth, 50U);
  HazardTrials trials(methods_, scene_.classes, choice_of({}));
  look(trials, "000000");
  EXPECT_EQ(trials.frames_without_ground(), 1U);
  EXPECT_TRUE(trials.is_empty());
  EXPECT_TRUE(hazard_json(trials, 0).at("hazards").empty());
  EXPECT_TRUE(hazard_json(trials, 0).at("disturbances").empty());
}

TEST(HazardChoice, RefusesAnUnknownWordAndNamesTheKnownOnes) {
  HazardChoice choice;
  const Status chosen = choose(std::vector<std::string>{"child", "elephant"}, choice);
  ASSERT_FALSE(chosen);
  EXPECT_THAT(chosen.error().message,
              AllOf(HasSubstr("elephant"), HasSubstr("lying_person"), HasSubstr("ghosts_1")));
}

}  // namespace
}  // namespace terracut::hazards
