// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A sensor that sees well, then less, then well again: the live chain in simulated time, and what
// people, Prometheus, ROS and the vehicle's bus are told by then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/health/health_frames.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "pipeline/publish/diagnosis.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/figures.hpp"
#include "tests/simulation/live_chain.hpp"
#include "tools/cli/export/metrics_text.hpp"

namespace terracut::simulation {
namespace {

using publish::Diagnosis;
using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLookEvery_ns = 50'000'000;  // as `terracut live` does
constexpr std::size_t kClearTurns = 24, kTroubledTurns = 24;

/// True for returns of an HDL-64E that something takes away, by the head's azimuth and distance.
using TakesAway = std::function<bool(double head_deg, double distance_m)>;

bool is_behind_a_hand(double head_deg, double /*distance_m*/) {
  return head_deg >= 30 && head_deg < 100;
}
bool is_in_fog(double /*head_deg*/, double distance_m) {
  return distance_m > 12;
}

void take_away(SensorLoop::Packet& packet, const TakesAway& takes) {
  constexpr std::size_t kBlocks = 12, kBlockBytes = 100, kReturns = 32;
  const auto number_at = [&](std::size_t at) { return packet[at] | packet[at + 1] << 8; };
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::size_t begin = block * kBlockBytes;
    const double head_deg = number_at(begin + 2) * 0.01;
    for (std::size_t i = 0; i < kReturns; ++i) {
      const std::size_t at = begin + 4 + 3 * i;
      if (takes(head_deg, number_at(at) * 0.002)) packet[at] = packet[at + 1] = 0;
    }
  }
}

/// Turns as they are, then turns from which something is taken away, over and over.
SensorLoop troubled(const SensorLoop& clear, const TakesAway& takes) {
  SensorLoop loop = clear;
  loop.packets.clear();
  for (std::size_t turn = 0; turn < kClearTurns + kTroubledTurns; ++turn) {
    const std::size_t from = turn % clear.turns() * clear.packets_per_turn;
    for (std::size_t i = 0; i < clear.packets_per_turn; ++i) {
      loop.packets.push_back(clear.packets[from + i]);
      if (turn >= kClearTurns) take_away(loop.packets.back(), takes);
    }
  }
  return loop;
}

/// A live run with --sight, behind whose thread with a deadline its other threads take what came
/// whenever that thread has done a round.
class WatchedRun {
 public:
  explicit WatchedRun(const SensorLoop& loop)
      : loop_(loop),
        network_(loop, {}, faults_, machine_, 7'000, 2),
        chain_(loop, method(), machine_, network_),
        sight_({.sight = true}, loop.profile, chain_.turns.decoder().shape(),
               chain_.turns.decoder().return_capacity(), chain_.turns.decoder().beam_turns()) {
    network_.begin_with_first_packet();
  }

  /// Runs until a look at the figures shows `wanted`; returns how long after `since_ns` that is,
  /// nothing if it is not within `patience_ns`.
  std::optional<std::int64_t> time_until(std::int64_t since_ns, std::int64_t patience_ns,
                                         const std::function<bool()>& wanted) {
    while (machine_.now_ns() < since_ns + patience_ns) {
      chain_.work_round();
      hand_out();
      if (machine_.now_ns() < next_look_ns_) continue;
      next_look_ns_ = machine_.now_ns() + kLookEvery_ns;
      figures().sight = sight_.found().sight();
      if (machine_.now_ns() >= since_ns && wanted()) return machine_.now_ns() - since_ns;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::int64_t begin_of_trouble_ns() const {
    return static_cast<std::int64_t>(kClearTurns) * loop_.turn_ns();
  }
  [[nodiscard]] std::int64_t end_of_trouble_ns() const {
    return static_cast<std::int64_t>(kClearTurns + kTroubledTurns) * loop_.turn_ns();
  }

  [[nodiscard]] status::MonitorSnapshot& figures() { return chain_.monitor.snapshot(); }
  /// What `terracut top` shows.
  [[nodiscard]] std::string lines() { return figure_lines(status::figures_of(figures()), {}); }
  [[nodiscard]] std::string metrics() { return cli::metrics_text(figures()); }
  [[nodiscard]] Diagnosis diagnosis() {
    const auto all = publish::Diagnoses().of(figures());
    const auto found = std::ranges::find(all, std::string("terracut: sight"), &Diagnosis::name);
    return found == all.end() ? Diagnosis{} : *found;
  }
  /// The lowest five bits: state and cause.
  [[nodiscard]] int can_bits() { return health::sight_frame(figures().sight, 0).data[0] & 0x1F; }

 private:
  static ground::TurnMethodMaker method() {
    ground::SegmenterConfig config = ground::terracut_profile();
    config.gives_heights = true;
    return ground::turn_maker_of(config, ground::Pace::kLatency);
  }
  void hand_out() {
    for (live::FramePool<points::LabelledPoint>::Frame frame; chain_.points.take(frame);) {
      sight_.find(frame.record.info, frame.items, frame.heights_m);
      chain_.points.give_back(true);
    }
    for (live::FramePool<frame::Label>::Frame frame; chain_.labels.take(frame);) {
      chain_.labels.give_back(true);
    }
    for (live::SectorPool::Frame sector; chain_.sectors.take(sector);) {
      chain_.sectors.give_back(true);
    }
    for (status::FrameRecord record; chain_.records.take(record);) chain_.monitor.judge(record);
  }

  const SensorLoop& loop_;
  Faults faults_;
  Machine machine_{faults_, 1};
  Network network_;
  LiveChain chain_;
  points::SceneOfPoints sight_;
  std::int64_t next_look_ns_ = 0;
};

TEST(SightOfALiveRun, IsBlockedWithinASecondOfAHandBeforeTheLens) {
  const SensorLoop loop = troubled(hdl64e_loop(), is_behind_a_hand);
  WatchedRun run(loop);
  const std::int64_t begin_ns = run.begin_of_trouble_ns();
  ASSERT_TRUE(run.time_until(0, begin_ns, [&] { return run.figures().sight.has_learnt != 0; }));
  EXPECT_THAT(run.lines(), HasSubstr("sight     clear"));
  EXPECT_EQ(run.diagnosis().level, Diagnosis::Severity::kOk);
  EXPECT_EQ(run.can_bits(), 1);

  const auto blocked = [&] { return run.can_bits() == (4 << 2 | 3); };
  EXPECT_TRUE(run.time_until(begin_ns, kSecond_ns, blocked));
  EXPECT_THAT(run.lines(), HasSubstr("sight     blocked, covered: "));
  EXPECT_THAT(run.lines(), HasSubstr("ahead right and right"));
  EXPECT_THAT(run.metrics(), HasSubstr("terracut_sight_state{state=\"blocked\"} 1"));
  EXPECT_THAT(run.metrics(), HasSubstr("terracut_sight_troubled_sectors{direction=\"left\"} 0"));
  EXPECT_EQ(run.diagnosis().level, Diagnosis::Severity::kError);
  EXPECT_THAT(run.diagnosis().message, HasSubstr("blocked, covered"));

  const auto clear = [&] { return run.can_bits() == 1; };
  EXPECT_TRUE(run.time_until(run.end_of_trouble_ns(), kSecond_ns, clear)) << "the hand is gone";
  EXPECT_THAT(run.lines(), HasSubstr("sight     clear"));
}

TEST(SightOfALiveRun, IsReducedWithinASecondOfFog) {
  const SensorLoop loop = troubled(hdl64e_loop(), is_in_fog);
  WatchedRun run(loop);
  const auto foggy = [&] { return run.can_bits() == (3 << 2 | 2); };
  EXPECT_FALSE(run.time_until(0, run.begin_of_trouble_ns(), foggy));
  EXPECT_TRUE(run.time_until(run.begin_of_trouble_ns(), kSecond_ns, foggy));
  EXPECT_THAT(run.lines(), HasSubstr("sight     reduced, fog: all around"));
  EXPECT_THAT(run.metrics(), HasSubstr("terracut_sight_state{state=\"reduced\"} 1"));
  EXPECT_EQ(run.diagnosis().level, Diagnosis::Severity::kWarn);
  EXPECT_LT(run.figures().sight.in(visibility::Direction::kAhead).visible_m, 13);
}

}  // namespace
}  // namespace terracut::simulation
