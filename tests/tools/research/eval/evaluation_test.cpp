// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/evaluation.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cstring>
#include <limits>

#include "made_up_dataset.hpp"
#include "tests/support/no_threads.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/statistics/measures.hpp"

namespace terracut::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class EvaluationTest : public testing::Test {
 protected:
  EvaluationTest() {
    config_.root = dataset_.root();
    config_.layout = *datasets::built_in_table("semantickitti")->layout();
    config_.jobs = 2;
    config_.methods = {*method_named("terracut"), *method_named("ring_map")};
  }
  EvaluationOutcome run(Journal* journal = nullptr, std::size_t frames_before_stop = SIZE_MAX) {
    std::atomic<std::size_t> done = 0;
    auto outcome = evaluate(
        config_, journal, [&](std::size_t now, std::size_t) { done = now; },
        [&] { return done >= frames_before_stop; });
    EXPECT_TRUE(outcome) << outcome.error().message;
    return outcome ? *std::move(outcome) : EvaluationOutcome{};
  }
  [[nodiscard]] Journal journal() {
    return *Journal::open(dataset_.root() / "results.journal", "settings");
  }
  /// What results are, apart from times.
  static std::map<FrameKey, statistics::FrameCounts> counts_of(const FrameResults& results) {
    std::map<FrameKey, statistics::FrameCounts> counts;
    for (const auto& [key, result] : results) counts[key] = result.counts;
    return counts;
  }

  MadeUpDataset dataset_;
  EvaluationConfig config_;
};

TEST_F(EvaluationTest, LabelsEveryFrameWithEveryMethod) {
  const EvaluationOutcome outcome = run();
  EXPECT_EQ(outcome.results.size(), 2U * 2U * MadeUpDataset::kFrames);
  EXPECT_TRUE(outcome.faults.empty());
  EXPECT_FALSE(outcome.interrupted);
  const auto classes = datasets::built_in_table("semantickitti");
  for (const auto& [key, result] : outcome.results) {
    std::uint64_t counted = 0;
    for (const auto& [place, labels] : result.counts.by_class_and_band()) {
      counted += labels.ground + labels.obstacle;
    }
    EXPECT_EQ(counted, result.points) << key.frame;
    EXPECT_GT(result.times.segment_ns, 0);
    EXPECT_GT(statistics::quality_of(result.counts, *classes, {}).iou_ground(), 0.9) << key.method;
  }
}

TEST_F(EvaluationTest, GivesTheSameWhateverTheNumberOfJobs) {
  const auto two = counts_of(run().results);
  {
    const test::NoThreads refused;
    EXPECT_EQ(counts_of(run().results), two);
  }
  config_.jobs = 1;
  EXPECT_EQ(counts_of(run().results), two);
  config_.jobs = 5;
  EXPECT_EQ(counts_of(run().results), two);
}

TEST_F(EvaluationTest, TakesOnlyTheSequencesFramesAndMethodsItIsTold) {
  config_.sequences = {"03"};
  config_.frames = {0, 2, 2};
  config_.methods = {*method_named("paper")};
  const auto results = run().results;
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results.contains({"03", "000000", "paper"}));
  EXPECT_TRUE(results.contains({"03", "000002", "paper"}));
}

TEST_F(EvaluationTest, WritesPredictionsWithOneLabelAPoint) {
  config_.predictions = dataset_.root() / "predictions";
  const auto results = run().results;
  for (const auto& [key, result] : results) {
    const auto path = config_.predictions / key.method / "sequences" / key.sequence /
                      "predictions" / (key.frame + ".label");
    const std::string bytes = test::content_of(path);
    ASSERT_EQ(bytes.size(), 4 * result.points) << path;
    std::uint64_t ground = 0, counted_ground = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      std::uint32_t label = 0;
      std::memcpy(&label, bytes.data() + i, 4);
      ground += label == 40 ? 1 : 0;
    }
    for (const auto& [place, labels] : result.counts.by_class_and_band()) {
      counted_ground += labels.ground;
    }
    EXPECT_EQ(ground, counted_ground);
  }
}

TEST_F(EvaluationTest, GoesOnWhereItWasInterrupted) {
  config_.jobs = 1;
  EvaluationOutcome first;
  {
    Journal begun = journal();
    first = run(&begun, 2);
  }
  EXPECT_TRUE(first.interrupted);
  EXPECT_EQ(first.results.size(), 2U * 2U);  // two frames, two methods
  Journal again = journal();
  const EvaluationOutcome second = run(&again);
  EXPECT_FALSE(second.interrupted);
  const auto whole = counts_of(run().results);
  EXPECT_EQ(counts_of(second.results), whole);
  // Nothing is done twice: the times are those of the first run.
  for (const auto& [key, result] : first.results) {
    EXPECT_EQ(second.results.at(key).times.segment_ns, result.times.segment_ns);
  }
}

TEST_F(EvaluationTest, ThroughPacketsLosesNextToNothing) {
  config_.methods = {*method_named("terracut")};
  const auto direct = run().results;
  config_.through_packets = true;
  const EvaluationOutcome outcome = run();
  EXPECT_TRUE(outcome.faults.empty());
  ASSERT_EQ(outcome.results.size(), direct.size());
  const auto classes = datasets::built_in_table("semantickitti");
  for (const auto& [key, result] : outcome.results) {
    EXPECT_LT(result.not_placed, result.points / 100) << key.frame;
    EXPECT_GT(result.times.decode_ns, 0);
    EXPECT_NEAR(statistics::quality_of(result.counts, *classes, {}).iou_ground(),
                statistics::quality_of(direct.at(key).counts, *classes, {}).iou_ground(), 0.02);
  }
}

// --- What is wrong with a dataset is said by file, and the rest is evaluated ---

class FaultyDataset : public EvaluationTest {
 protected:
  /// The one fault there must be; all other frames have results.
  Fault the_fault() {
    config_.methods = {*method_named("terracut")};
    const EvaluationOutcome outcome = run();
    EXPECT_EQ(outcome.faults.size(), 1U);
    EXPECT_EQ(outcome.results.size(), 2U * MadeUpDataset::kFrames - 1);
    return outcome.faults.empty() ? Fault{} : outcome.faults.front();
  }
};

TEST_F(FaultyDataset, WithoutALabelFileForAFrame) {
  std::filesystem::remove(dataset_.labels("00", 1));
  EXPECT_THAT(the_fault().what, HasSubstr("000001.bin: there is no label file for it"));
}

TEST_F(FaultyDataset, WithFewerLabelsThanPoints) {
  const std::string labels = test::content_of(dataset_.labels("00", 1));
  dataset_.write(dataset_.labels("00", 1), labels.substr(0, labels.size() - 4));
  EXPECT_THAT(the_fault().what, HasSubstr("000001.label"));
}

TEST_F(FaultyDataset, WithATruncatedScan) {
  const std::string points = test::content_of(dataset_.points("03", 0));
  dataset_.write(dataset_.points("03", 0), points.substr(0, points.size() / 2 + 5));
  EXPECT_THAT(the_fault().what, HasSubstr("000000.bin"));
}

TEST_F(FaultyDataset, WithAnEmptyScan) {
  dataset_.write(dataset_.points("03", 2), "");
  EXPECT_THAT(the_fault().what, HasSubstr("000002.bin"));
}

TEST_F(FaultyDataset, WithAScanThatIsALinkToNowhere) {
  std::filesystem::remove(dataset_.points("03", 2));
  std::filesystem::create_symlink(dataset_.root() / "nowhere", dataset_.points("03", 2));
  EXPECT_THAT(the_fault().what, HasSubstr("000002.bin"));
}

TEST_F(FaultyDataset, WithAScanOfZeros) {
  dataset_.write(dataset_.points("00", 1),
                 std::string(test::content_of(dataset_.points("00", 1)).size(), 0));
  EXPECT_THAT(the_fault().what, AllOf(HasSubstr("000001.bin"), HasSubstr("finite and not null")));
}

TEST_F(FaultyDataset, WithLabelsThatHaveNoScan) {
  std::filesystem::remove(dataset_.points("03", 1));
  EXPECT_THAT(the_fault().what, HasSubstr("000001.label: there is no scan for it"));
  // Who asks for certain frames does not ask whether the rest is there.
  config_.frames = {.first = 0, .last = 0};
  EXPECT_TRUE(run().faults.empty());
}

TEST_F(FaultyDataset, WithASequenceThatHasNoScans) {
  std::filesystem::remove_all(dataset_.root() / "sequences" / "00" / "velodyne");
  std::filesystem::create_directories(dataset_.root() / "sequences" / "00" / "velodyne");
  config_.methods = {*method_named("terracut")};
  const EvaluationOutcome outcome = run();
  ASSERT_EQ(outcome.faults.size(), 1U);
  EXPECT_THAT(outcome.faults.front().where, HasSubstr("sequences/00"));
  EXPECT_EQ(outcome.results.size(), std::size_t{MadeUpDataset::kFrames});
}

TEST_F(FaultyDataset, WithPointsThatAreNoPlacesCountsThemAndLabelsTheRest) {
  std::string points = test::content_of(dataset_.points("00", 0));
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity()};
  std::memcpy(points.data(), &bad[0], 4);            // x of point 0
  std::memcpy(points.data() + 16 * 50, &bad[1], 4);  // x of point 50
  float zero = -0.0F;
  std::memcpy(points.data() + 16 * 70 + 4, &zero, 4);  // y of point 70
  dataset_.write(dataset_.points("00", 0), points);
  config_.methods = {*method_named("terracut")};
  const EvaluationOutcome outcome = run();
  EXPECT_TRUE(outcome.faults.empty());
  const FrameResult& result = outcome.results.at({"00", "000000", "terracut"});
  EXPECT_EQ(result.non_finite, 2U);
  std::uint64_t counted = 0;
  for (const auto& [place, labels] : result.counts.by_class_and_band()) {
    counted += labels.ground + labels.obstacle;
  }
  EXPECT_EQ(counted, result.points - 2);
}

TEST_F(FaultyDataset, WithoutAnySequenceIsRefused) {
  config_.root = dataset_.root() / "nothing";
  const auto outcome =
      evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kNotFound);
}

TEST_F(EvaluationTest, EndsWhenPredictionsCannotBeWritten) {
  dataset_.write(dataset_.root() / "predictions", "a file where a folder should be");
  config_.predictions = dataset_.root() / "predictions";
  const auto outcome =
      evaluate(config_, nullptr, [](std::size_t, std::size_t) {}, [] { return false; });
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kWriteFailed);
}

}  // namespace
}  // namespace terracut::eval
