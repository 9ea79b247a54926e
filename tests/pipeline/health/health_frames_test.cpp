// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The frames as a reader with nothing but terracut_health.dbc sees them.
#include "pipeline/health/health_frames.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "firmware_io/vehicle/signal_plan.hpp"
#include "tests/firmware_io/can/frames.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using health::health_frames;
using health::HealthReport;
using testing::HasSubstr;
using vehicle::SignalPlan;

const std::filesystem::path kDbc = test::source_folder() / "pipeline/health/terracut_health.dbc";

class HealthFrames : public testing::Test {
 protected:
  void SetUp() override {
    auto file = vehicle::read_dbc(kDbc);
    ASSERT_TRUE(file) << file.error().message;
    file_ = *std::move(file);
    text_ = test::content_of(kDbc);
  }
  double value(const HealthReport& report, std::string_view signal) {
    const auto plan = SignalPlan::make(file_, signal);
    EXPECT_TRUE(plan) << plan.error().message;
    for (const CanFrame& frame : health_frames(report)) {
      if (frame.id == plan->id()) return plan->value(frame).value_or(NAN);
    }
    return NAN;
  }
  double value(const visibility::SightFigures& sight, std::string_view signal) {
    const auto plan = SignalPlan::make(file_, signal);
    EXPECT_TRUE(plan) << plan.error().message;
    const CanFrame frame = health::sight_frame(sight, 513);
    EXPECT_EQ(frame.id, plan->id());
    return plan->value(frame).value_or(NAN);
  }

  vehicle::DbcFile file_;
  std::string text_;
};

TEST_F(HealthFrames, HoldEveryFigureWhereTheDbcSaysItIs) {
  const HealthReport report{.frame_number = 0x1ABCD,
                            .returns = 230'400,
                            .level = status::Level::kCoarse,
                            .missed = true,
                            .cause = status::FrameMissCause::kStolenTime,
                            .latency_ns = 53'219'999,
                            .ego_motion = true,
                            .link = status::LinkState::kSilent,
                            .misses = 70'000,
                            .skipped = 3,
                            .losses = 0x1234567,
                            .alive = 513};
  EXPECT_EQ(value(report, "FrameNumber"), 0xABCD);
  EXPECT_EQ(value(report, "Level"), 2);
  EXPECT_EQ(value(report, "Missed"), 1);
  EXPECT_EQ(value(report, "MissCause"), 2);
  EXPECT_EQ(value(report, "EgoMotion"), 1);
  EXPECT_NEAR(value(report, "Latency"), 53.21, 1e-9);
  EXPECT_EQ(value(report, "Returns"), 230'400);
  EXPECT_EQ(value(report, "Link"), 2);
  EXPECT_EQ(value(report, "Misses"), 70'000 - 65'536);
  EXPECT_EQ(value(report, "Skipped"), 3);
  EXPECT_EQ(value(report, "Losses"), 0x234567);
  EXPECT_EQ(value(report, "Alive"), 1);
}

TEST_F(HealthFrames, KeepEachFigureApartFromTheOthers) {
  const auto frames = health_frames({});
  for (const auto& message : file_.messages) {
    std::vector<int> owner(64, 0);
    for (const auto& signal : message.signals) {
      EXPECT_FALSE(signal.motorola);
      for (int i = 0; i < signal.bit_count; ++i) {
        EXPECT_EQ(owner.at(static_cast<std::size_t>(signal.start_bit + i))++, 0) << signal.name;
      }
    }
  }
  EXPECT_EQ(frames[0].length, 8);
  EXPECT_EQ(frames[1].id.number, frames[0].id.number + 1);
}

TEST_F(HealthFrames, SayWhatIsNotKnownAndStayAtTheMostThereIs) {
  EXPECT_NEAR(value({.latency_ns = -1}, "Latency"), 655.35, 1e-9);
  EXPECT_NEAR(value({.level = status::Level::kSkipped, .latency_ns = 5}, "Latency"), 655.35, 1e-9);
  EXPECT_NEAR(value({.latency_ns = 655'339'999}, "Latency"), 655.33, 1e-9);
  EXPECT_NEAR(value({.latency_ns = std::int64_t{3'600'000'000'000}}, "Latency"), 655.34, 1e-9);
  EXPECT_EQ(value({.latency_ns = 0}, "Latency"), 0);
  EXPECT_EQ(value({.returns = 262'144}, "Returns"), 262'143);
  EXPECT_EQ(value({.missed = false, .cause = status::FrameMissCause::kLateInput}, "MissCause"), 7);
}

TEST_F(HealthFrames, HaveTheirNamesOfValuesInTheDbc) {
  for (std::size_t i = 0; i < status::kLevels; ++i) {
    EXPECT_THAT(text_,
                HasSubstr(fmt::format("{} \"{}\"", i, to_string(static_cast<status::Level>(i)))));
  }
  for (std::size_t i = 0; i < status::kMissCauses; ++i) {
    const auto name = to_string(static_cast<status::FrameMissCause>(i));
    EXPECT_THAT(text_, HasSubstr(fmt::format("{} \"{}\"", i, name)));
  }
  for (std::size_t i = 0; i < visibility::kCauseNames.size(); ++i) {
    EXPECT_THAT(text_, HasSubstr(fmt::format("{} \"{}\"", i, visibility::kCauseNames[i])));
  }
  for (std::size_t i = 0; i < visibility::kStateNames.size(); ++i) {
    EXPECT_THAT(text_, HasSubstr(fmt::format("{} \"{}\"", i + 1, visibility::kStateNames[i])));
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(status::LinkState::kCount); ++i) {
    const auto name = to_string(static_cast<status::LinkState>(i));
    EXPECT_THAT(text_, HasSubstr(fmt::format("{} \"{}\"", i, name)));
  }
}

TEST_F(HealthFrames, TellWhatIsInTheSensorsWayAndWhere) {
  using visibility::Cause;
  using visibility::State;
  visibility::SightFigures sight;
  EXPECT_EQ(value(sight, "View"), 0) << "the view is being learnt";
  EXPECT_EQ(value(sight, "VisibleAhead"), 255) << "nothing was seen yet";
  sight.has_learnt = 1;
  for (auto& sector : sight.sectors) sector = {{}, 1, 38.9F};
  EXPECT_EQ(value(sight, "View"), 1);
  EXPECT_EQ(value(sight, "ViewCause"), 0);
  EXPECT_EQ(value(sight, "TroubledSectors"), 0);
  EXPECT_EQ(value(sight, "VisibleAhead"), 38);
  for (const std::size_t i : {0U, 7U, 35U}) {
    sight.sectors[i] = {{State::kBlocked, Cause::kCovered}, 1, 0};
  }
  sight.sectors[20].condition = {State::kReduced, Cause::kAirborne};
  EXPECT_EQ(value(sight, "View"), 3);
  EXPECT_EQ(value(sight, "ViewCause"), 4);
  EXPECT_EQ(value(sight, "TroubledCount"), 4);
  EXPECT_EQ(value(sight, "TroubledSectors"),
            static_cast<double>(1ULL | 1ULL << 7 | 1ULL << 20 | 1ULL << 35));
  EXPECT_EQ(value(sight, "VisibleAhead"), 0);
  EXPECT_EQ(value(sight, "ViewAlive"), 1);
}

TEST_F(HealthFrames, GoByOtherIdsWhereTheseAreTaken) {
  const auto frames = health_frames({}, {0x18FF0000, true});
  EXPECT_EQ(frames[0].id, (can::CanId{0x18FF0000, true}));
  EXPECT_EQ(frames[1].id, (can::CanId{0x18FF0001, true}));
}

TEST(HealthReport, SaysWhatTheFiguresOfALiveProcessSay) {
  auto figures = std::make_unique<status::MonitorSnapshot>();
  status::FrameRecord newest;
  newest.info.number = 17;
  newest.info.returns = 1000;
  newest.level = status::Level::kCutStopped;
  newest.missed = true;
  newest.cause = status::FrameMissCause::kWaitingForCore;
  figures->link = status::LinkState::kReceiving;
  figures->misses = {1, 2, 3, 4};
  figures->levels[static_cast<std::size_t>(status::Level::kSkipped)] = 5;
  figures->loss_count = 3;
  figures->losses[0].count = 6;
  figures->losses[1].count = 7;
  figures->losses[2] = {"foxglove_messages_skipped", 50};  // no loss
  figures->losses[3].count = 100;                          // not in use
  HealthReport report = health::health_report_of(*figures, newest);
  EXPECT_EQ(report.frame_number, 17U);
  EXPECT_EQ(report.returns, 1000U);
  EXPECT_EQ(report.level, status::Level::kCutStopped);
  EXPECT_TRUE(report.missed);
  EXPECT_EQ(report.cause, status::FrameMissCause::kWaitingForCore);
  EXPECT_EQ(report.link, status::LinkState::kReceiving);
  EXPECT_EQ(report.misses, 10U);
  EXPECT_EQ(report.skipped, 5U);
  EXPECT_EQ(report.losses, 13U);
  EXPECT_LT(report.latency_ns, 0) << "no stamps";

  newest.info.last_packet_ns = 1'000;
  newest.labels_ns = 43'001'000;
  EXPECT_EQ(health::health_report_of(*figures, newest).latency_ns, 43'000'000);
  newest.labels_ns = 1'000;
  EXPECT_EQ(health::health_report_of(*figures, newest).latency_ns, 0);
  newest.labels_ns = 999;  // the clock was set back meanwhile
  EXPECT_LT(health::health_report_of(*figures, newest).latency_ns, 0);
}

}  // namespace
}  // namespace terracut::test
