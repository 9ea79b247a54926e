// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/support/scratch_folder.hpp"
#include "tools/research/datasets/dataset.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <iterator>

#include "tests/tools/research/eval/made_up_koblenz.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/evaluation.hpp"
#include "tools/research/statistics/measures.hpp"

namespace terracut::datasets {
namespace {

using test::content_of;
using testing::ElementsAre;
using testing::HasSubstr;

CloudLayout koblenz() {
  return *built_in_table("koblenz")->layout();
}

class KoblenzTest : public testing::Test {
 protected:
  KoblenzTest() {
    config_.layout = koblenz();
    config_.root = made_up_.root();
    config_.jobs = 2;
    config_.methods = {*eval::method_named("terracut")};
  }
  eval::EvaluationOutcome run() {
    auto outcome =
        eval::evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
    EXPECT_TRUE(outcome) << outcome.error().message;
    return outcome ? *std::move(outcome) : eval::EvaluationOutcome{};
  }
  /// Of the one file of KoblenzFarmMap that was replaced; the other three have results.
  std::string fault_of(const std::string& content) {
    made_up_.write(made_up_.file("KoblenzFarmMap", 1), content);
    const eval::EvaluationOutcome outcome = run();
    EXPECT_EQ(outcome.results.size(), 3U);
    EXPECT_EQ(outcome.faults.size(), 1U);
    const std::string what = outcome.faults.empty() ? "" : outcome.faults.front().what;
    EXPECT_THAT(what, HasSubstr("KoblenzFarmMap/0001.pcd"));
    return what;
  }
  /// The text of that file, whose first point is line 12, changed.
  [[nodiscard]] std::string with(const std::string& what, const std::string& instead) const {
    std::string text = content_of(made_up_.file("KoblenzFarmMap", 1));
    return text.replace(text.find(what), what.size(), instead);
  }

  eval::MadeUpKoblenz made_up_;
  eval::EvaluationConfig config_;
};

TEST_F(KoblenzTest, EveryFolderWithCloudsIsASequence) {
  std::filesystem::create_directories(made_up_.root() / "papers");
  const auto names = Dataset::at(koblenz(), made_up_.root())->sequences();
  ASSERT_TRUE(names);
  EXPECT_THAT(*names, ElementsAre("KoblenzFarmMap", "KoblenzForestMap"));
}

TEST_F(KoblenzTest, PutsLasersInOrderWhateverTheirNumbers) {
  const auto sequence = Dataset::at(koblenz(), made_up_.root())->open("KoblenzForestMap");
  ASSERT_TRUE(sequence) << sequence.error().message;
  LabelledScan scan;
  ASSERT_TRUE(sequence->read(0, scan));
  ASSERT_EQ(scan.scan.points.size(), 64U * eval::MadeUpKoblenz::kPointsPerRing);
  EXPECT_EQ(scan.rings.rings, 64);
  EXPECT_EQ(scan.rings.no_ring, 0U);
  for (std::size_t i = 0; i < scan.rings.ring_of_point.size(); ++i) {
    ASSERT_EQ(scan.rings.ring_of_point[i], static_cast<int>(i % 64)) << "point " << i;
  }
}

TEST_F(KoblenzTest, MeasuresTheElevationsOfTheUnit) {
  const auto sequence = Dataset::at(koblenz(), made_up_.root())->open("KoblenzFarmMap");
  ASSERT_TRUE(sequence) << sequence.error().message;
  const auto& table = sequence->rings();
  const auto truth = synthetic::table();
  for (std::size_t ring = 0; ring < table.size(); ++ring) {
    EXPECT_NEAR(table[ring].elevation_rad, truth[ring].elevation_rad, 2e-3) << ring;
  }
}

TEST_F(KoblenzTest, LasersThatSawNothingCostOnlyTheirOwnPoints) {
  // Laser 29, the highest, measures nothing but what is no place.
  for (int i = 0; i < eval::MadeUpKoblenz::kFrames; ++i) {
    std::string cloud = eval::MadeUpKoblenz::cloud(i, eval::MadeUpKoblenz::Data::kBinary);
    const std::size_t data = cloud.find("DATA binary\n") + 12;
    const float none = NAN;
    for (std::size_t p = 0; p < eval::MadeUpKoblenz::kPointsPerRing; ++p) {
      std::memcpy(cloud.data() + data + p * 64 * 17, &none, 4);
    }
    made_up_.write(made_up_.file("KoblenzForestMap", i), cloud);
  }
  const auto sequence = Dataset::at(koblenz(), made_up_.root())->open("KoblenzForestMap");
  ASSERT_TRUE(sequence) << sequence.error().message;
  LabelledScan scan;
  ASSERT_TRUE(sequence->read(1, scan));
  EXPECT_EQ(scan.rings.rings, 63);
  EXPECT_EQ(scan.scan.no_place, std::size_t{eval::MadeUpKoblenz::kPointsPerRing});
  EXPECT_EQ(scan.rings.no_ring, scan.scan.no_place);
  EXPECT_EQ(scan.rings.ring_of_point[1], 0);
}

TEST_F(KoblenzTest, IsEvaluatedUnderItsOwnClasses) {
  const auto classes = built_in_table("koblenz");
  ASSERT_TRUE(classes);
  for (const bool through_packets : {false, true}) {
    config_.through_packets = through_packets;
    const eval::EvaluationOutcome outcome = run();
    EXPECT_TRUE(outcome.faults.empty());
    ASSERT_EQ(outcome.results.size(), 4U);
    for (const auto& [key, result] : outcome.results) {
      EXPECT_EQ(result.no_ring, 0U);
      EXPECT_FALSE(result.rings_realigned);
      EXPECT_LT(result.not_placed, result.points / 100);
      const auto quality = statistics::quality_of(result.counts, *classes, {});
      EXPECT_GT(quality.iou_ground(), 0.9) << key.sequence;
      EXPECT_GT(quality.recall_key_obstacles(), 0.9) << key.sequence;
      // Under `road` the rough ground before 8 m is an obstacle, which it does not look like.
      EXPECT_LT(statistics::quality_of(result.counts, *classes, {GroundDefinition::kRoad, true, {}})
                    .iou_ground(),
                0.8);
    }
  }
}

TEST_F(KoblenzTest, ReadsARingWhereThereIsNoLaser) {
  made_up_.write(made_up_.file("KoblenzFarmMap", 1), with("z laser label", "z ring label"));
  EXPECT_TRUE(run().faults.empty());
}

TEST_F(KoblenzTest, FaultyFilesAreNamedAndTheRestEvaluated) {
  EXPECT_THAT(fault_of(with("laser label", "laser colour")),
              HasSubstr("there is no field 'label'; it has: x y z laser colour"));
}
TEST_F(KoblenzTest, AFileWithoutLasersIsNamed) {
  EXPECT_THAT(fault_of(with("laser label", "lidar label")), HasSubstr("there is no field 'laser'"));
}
TEST_F(KoblenzTest, AFileWithoutCoordinatesIsNamed) {
  EXPECT_THAT(fault_of(with("x y z laser", "x y t laser")), HasSubstr("the fields x, y and z"));
}
TEST_F(KoblenzTest, AFileWithImpossibleLasersIsNamed) {
  EXPECT_THAT(fault_of(with(" 29 3\n", " 64 3\n")), HasSubstr("laser of point 0 is 64"));
}
TEST_F(KoblenzTest, AFileWithImpossibleLabelsIsNamed) {
  EXPECT_THAT(fault_of(with(" 29 3\n", " 29 -1\n")), HasSubstr("label of point 0 is -1"));
}
TEST_F(KoblenzTest, ATruncatedFileIsNamed) {
  std::string content = content_of(made_up_.file("KoblenzFarmMap", 1));
  EXPECT_THAT(fault_of(content.substr(0, content.size() / 2)), HasSubstr("0001.pcd: "));
}
TEST_F(KoblenzTest, AnEmptyFileIsNamed) {
  EXPECT_THAT(fault_of(""), HasSubstr("no PCD file"));
}

TEST_F(KoblenzTest, PointsInAMapsFrameAreRefusedBySequence) {
  for (int i = 0; i < eval::MadeUpKoblenz::kFrames; ++i) {
    made_up_.write(made_up_.file("KoblenzForestMap", i),
                   eval::MadeUpKoblenz::cloud(i, eval::MadeUpKoblenz::Data::kBinary, 60));
  }
  const eval::EvaluationOutcome outcome = run();
  EXPECT_EQ(outcome.results.size(), 2U);
  ASSERT_EQ(outcome.faults.size(), 1U);
  EXPECT_THAT(outcome.faults.front().where, HasSubstr("KoblenzForestMap"));
  EXPECT_THAT(outcome.faults.front().what, HasSubstr("do not lie on a cone"));
}

TEST_F(KoblenzTest, SaysWhatItExpectedWhereNothingFits) {
  config_.root = made_up_.root() / "nothing";
  const auto outcome =
      eval::evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(outcome.error().message, HasSubstr("nothing/* with *.pcd, found none"));
  EXPECT_FALSE(Dataset::at(koblenz(), made_up_.root())->open("KoblenzCampusMap"));
}

}  // namespace
}  // namespace terracut::datasets
