// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace terracut::publish {
namespace {

using Severity = Diagnosis::Severity;

/// A run that does well: a frame, and real-time threads.
std::unique_ptr<status::MonitorSnapshot> good_figures() {
  auto figures = std::make_unique<status::MonitorSnapshot>();
  figures->sensor = {"hdl64e, 10 Hz"};
  figures->link = status::LinkState::kReceiving;
  figures->frames = 1;
  figures->loss_count = 1;
  figures->losses[0] = {"kernel_drops", 0};
  figures->thread_count = 1;
  figures->threads[0].name = {"segment"};
  figures->threads[0].scheduling = {"SCHED_FIFO 70, core 1"};
  return figures;
}

Severity severity_of(const std::vector<Diagnosis>& all, const std::string& name) {
  const auto found = std::ranges::find(all, "terracut: " + name, &Diagnosis::name);
  return found == all.end() ? Severity::kStale : found->level;
}

TEST(Diagnoses, AreAllOkOfARunThatDoesWell) {
  for (const Diagnosis& each : Diagnoses().of(*good_figures())) {
    EXPECT_EQ(each.level, Severity::kOk) << each.name << ": " << each.message;
    EXPECT_EQ(each.hardware_id, "hdl64e, 10 Hz");
  }
}

TEST(Diagnoses, NameWhatIsWrongNow) {
  Diagnoses diagnoses;
  auto figures = good_figures();
  figures->consecutive_misses = 1;
  figures->link = status::LinkState::kSilent;
  figures->threads[0].scheduling = {"SCHED_OTHER, core 1"};
  figures->mount.guessed = 1;
  auto all = diagnoses.of(*figures);
  EXPECT_EQ(severity_of(all, "deadline"), Severity::kWarn);
  EXPECT_EQ(severity_of(all, "input"), Severity::kError);
  EXPECT_EQ(severity_of(all, "threads"), Severity::kWarn);
  EXPECT_EQ(severity_of(all, "mount"), Severity::kWarn);
  figures->consecutive_misses = 3;
  EXPECT_EQ(severity_of(diagnoses.of(*figures), "deadline"), Severity::kError);
}

TEST(Diagnoses, SayOnceThatSomethingWasLost) {
  Diagnoses diagnoses;
  auto figures = good_figures();
  figures->losses[0] = {"kernel_drops", 5};
  const auto first = diagnoses.of(*figures);
  const auto found = std::ranges::find(first, std::string("terracut: losses"), &Diagnosis::name);
  ASSERT_NE(found, first.end());
  EXPECT_EQ(found->level, Severity::kWarn);
  EXPECT_EQ(found->message, "something was lost in the last second");
  EXPECT_EQ(severity_of(diagnoses.of(*figures), "losses"), Severity::kOk);
}

TEST(Diagnoses, WarnOfNothingThatOnlookersAloneDidNotGet) {
  Diagnoses diagnoses;
  auto figures = good_figures();
  figures->losses[0] = {"view_frames_skipped_by_browsers", 5};
  EXPECT_EQ(severity_of(diagnoses.of(*figures), "losses"), Severity::kOk);
}

TEST(Diagnoses, JudgeTheViewWhereItIsWatched) {
  using visibility::Cause;
  using visibility::State;
  Diagnoses diagnoses;
  auto figures = good_figures();
  const auto sight = [&] {
    const auto all = diagnoses.of(*figures);
    const auto found = std::ranges::find(all, std::string("terracut: sight"), &Diagnosis::name);
    return found == all.end() ? Diagnosis{} : *found;
  };
  EXPECT_EQ(sight().name, "") << "nobody watches it";
  figures->sight.is_watched = 1;
  EXPECT_EQ(sight().level, Severity::kStale);
  figures->sight.has_learnt = 1;
  for (auto& sector : figures->sight.sectors) sector = {{}, 1, 30};
  EXPECT_EQ(sight().level, Severity::kOk);
  EXPECT_EQ(sight().message, "clear");
  figures->sight.sectors[0].condition = {State::kReduced, Cause::kAirborne};
  EXPECT_EQ(sight().level, Severity::kWarn);
  EXPECT_EQ(sight().message, "reduced, airborne: 1 sector, ahead");
  figures->sight.sectors[33] = {{State::kBlocked, Cause::kCovered}, 1, 0};
  const Diagnosis blocked = sight();
  EXPECT_EQ(blocked.level, Severity::kError);
  const std::pair<std::string, std::string> cause{"cause", "covered"},
      left{"visible_ahead_left_m", "30.0"};
  EXPECT_NE(std::ranges::find(blocked.values, cause), blocked.values.end());
  EXPECT_NE(std::ranges::find(blocked.values, left), blocked.values.end());
}

TEST(Diagnoses, WarnOfLossesInTheSecondInWhichTheyHappened) {
  Diagnoses diagnoses;
  auto figures = good_figures();
  figures->losses[0].count = 5;
  figures->unjudged = 1;
  auto all = diagnoses.of(*figures);
  EXPECT_EQ(severity_of(all, "losses"), Severity::kWarn);
  EXPECT_EQ(severity_of(all, "clock"), Severity::kWarn);
  all = diagnoses.of(*figures);
  EXPECT_EQ(severity_of(all, "losses"), Severity::kOk);
  EXPECT_EQ(severity_of(all, "clock"), Severity::kOk);
  const auto losses = std::ranges::find(all, std::string("terracut: losses"), &Diagnosis::name);
  ASSERT_EQ(losses->values.size(), 1U) << "the count stays to be seen";
  EXPECT_EQ(losses->values[0].second, "5");
}

}  // namespace
}  // namespace terracut::publish
