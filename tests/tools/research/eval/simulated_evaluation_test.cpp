// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/simulated_evaluation.hpp"

#include <gmock/gmock.h>

#include <iterator>
#include <map>

#include "tests/support/scratch_folder.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/statistics/measures.hpp"

namespace terracut::eval {
namespace {

using testing::HasSubstr;

class SimulatedEvaluationTest : public testing::Test {
 protected:
  SimulatedEvaluationTest() {
    config_.drives = {.scenes = {"flat"}, .duration_s = 0.2};
    config_.methods = {*method_named("terracut"), *method_named("ring_map")};
  }
  Expected<EvaluationOutcome> try_to_run(Journal* journal = nullptr,
                                         std::size_t frames_before_stop = SIZE_MAX) {
    simulated_s_ = 0;
    std::size_t done = 0;
    return evaluate_simulated(config_, journal,
                              {[&](double now_s, double) { simulated_s_ = now_s; },
                               [&](std::size_t now, std::size_t of) {
                                 done = now;
                                 of_ = of;
                               }},
                              [&] { return done >= frames_before_stop; });
  }
  EvaluationOutcome run(Journal* journal = nullptr, std::size_t frames_before_stop = SIZE_MAX) {
    auto outcome = try_to_run(journal, frames_before_stop);
    EXPECT_TRUE(outcome) << outcome.error().message;
    return outcome ? *std::move(outcome) : EvaluationOutcome{};
  }
  static std::map<FrameKey, statistics::FrameCounts> counts_of(const FrameResults& results) {
    std::map<FrameKey, statistics::FrameCounts> counts;
    for (const auto& [key, result] : results) counts[key] = result.counts;
    return counts;
  }

  SimulatedConfig config_;
  double simulated_s_ = 0;
  std::size_t of_ = 0;
};

TEST_F(SimulatedEvaluationTest, LabelsEveryFrameOfASensorInEitherReturnMode) {
  const auto classes = datasets::built_in_table("semantickitti");
  using sensor::SensorModel;
  for (const SensorModel sensor :
       {SensorModel::kHdl64e, SensorModel::kRuby128, SensorModel::kVlp32c}) {
    const std::uint64_t least = sensor == SensorModel::kVlp32c ? 25'000U : 50'000U;
    std::uint64_t points_in_single = 0;
    for (const bool dual : {false, true}) {
      SCOPED_TRACE(std::string(to_string(sensor)) + (dual ? " dual" : " single"));
      config_.drives.sensor = sensor;
      config_.drives.dual_return = dual;
      const EvaluationOutcome outcome = run();
      EXPECT_TRUE(outcome.faults.empty());
      ASSERT_EQ(outcome.results.size(), 2U * 2U);
      for (const auto& [key, result] : outcome.results) {
        EXPECT_EQ(key.sequence, "flat");
        std::uint64_t counted = 0;
        for (const auto& [place, labels] : result.counts.by_class_and_band()) {
          counted += labels.ground + labels.obstacle;
          EXPECT_NE(classes->find(place.class_id), nullptr) << place.class_id;
        }
        EXPECT_EQ(counted, result.points);
        EXPECT_GT(result.points, dual ? points_in_single : least);
        EXPECT_GT(result.times.decode_ns, 0);
        EXPECT_GT(result.times.segment_ns, 0);
        EXPECT_GT(statistics::quality_of(result.counts, *classes, {}).iou_ground(), 0.9)
            << key.method;
      }
      points_in_single = outcome.results.begin()->second.points;
    }
  }
}

TEST_F(SimulatedEvaluationTest, EveryAskedSceneIsASequence) {
  config_.drives.scenes = {"flat", "hill"};
  config_.drives.duration_s = 0.1;
  const FrameResults results = run().results;
  EXPECT_EQ(results.size(), 2U * 2U);
  EXPECT_TRUE(results.contains({"hill", "000000", "ring_map"}));
  EXPECT_EQ(of_, 2U);
}

TEST_F(SimulatedEvaluationTest, IsTheSameForTheSameSeedOnly) {
  const auto first = counts_of(run().results);
  EXPECT_EQ(counts_of(run().results), first);
  config_.drives.seed = 2;
  EXPECT_NE(counts_of(run().results), first);
}

TEST_F(SimulatedEvaluationTest, TakesOnlyTheFramesItIsTold) {
  config_.drives.duration_s = 0.3;
  config_.frames = {1, SIZE_MAX, 1};
  const auto results = run().results;
  EXPECT_EQ(results.size(), 2U * 2U);
  EXPECT_TRUE(results.contains({"flat", "000002", "terracut"}));
  EXPECT_FALSE(results.contains({"flat", "000000", "terracut"}));
}

TEST_F(SimulatedEvaluationTest, GoesOnWhereItWasInterruptedAndSimulatesNothingThatIsDone) {
  const test::ScratchFolder folder;
  const auto journal = [&] { return *Journal::open(folder.path() / "a.journal", "settings"); };
  EvaluationOutcome first;
  {
    Journal begun = journal();
    first = run(&begun, 1);
  }
  EXPECT_TRUE(first.interrupted);
  EXPECT_EQ(first.results.size(), 2U);
  {
    Journal again = journal();
    const EvaluationOutcome second = run(&again);
    EXPECT_FALSE(second.interrupted);
    EXPECT_EQ(counts_of(second.results), counts_of(run().results));
    for (const auto& [key, result] : first.results) {
      EXPECT_EQ(second.results.at(key).times.segment_ns, result.times.segment_ns);
    }
  }
  Journal whole = journal();
  EXPECT_EQ(run(&whole).results.size(), 4U);
  EXPECT_EQ(simulated_s_, 0);
}

TEST_F(SimulatedEvaluationTest, WritesALabelAReturn) {
  const test::ScratchFolder folder;
  config_.predictions = folder.path();
  for (const auto& [key, result] : run().results) {
    const auto path =
        folder.path() / key.method / "sequences/flat/predictions" / (key.frame + ".label");
    EXPECT_EQ(std::filesystem::file_size(path), 4 * result.points);
  }
}

TEST_F(SimulatedEvaluationTest, RefusesImpossibleScenesBeforeItSimulatesAny) {
  const auto expect_refusal = [&](std::vector<std::string> scenes, const std::string& message) {
    config_.drives.scenes = std::move(scenes);
    const auto outcome = try_to_run();
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(outcome.error().message, HasSubstr(message));
    EXPECT_EQ(simulated_s_, 0);
  };
  expect_refusal({"flat", "moon"}, "no scene 'moon'");
  expect_refusal({"flat", ""}, "no scene ''");
  expect_refusal({"flat", "flat"}, "a second time");
}

}  // namespace
}  // namespace terracut::eval
