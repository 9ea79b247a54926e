// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Packets and the vehicle's CAN frames together, as a live run hears them, through steps of the
// clock that stamps both, outages and packets that are held up: whatever happens, a frame that says
// that it was deskewed looks as it does when nothing happens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "firmware_io/can/candump_line.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::test {
namespace {

using frame::DeskewState;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000 * kMillisecond_ns;
constexpr std::int64_t kStart_ns = 1'700'000'000 * kSecond_ns;
constexpr std::int64_t kSamplePeriod_ns = 10 * kMillisecond_ns;
constexpr std::int64_t kFrames = 7;

/// What a clock shows at a time that never jumps.
using Clock = std::function<std::int64_t(std::int64_t)>;

std::int64_t right(std::int64_t time_ns) {
  return time_ns;
}
Clock stepping(std::int64_t at_ns, std::int64_t step_ns) {
  return [=](std::int64_t time_ns) { return time_ns + (time_ns >= at_ns ? step_ns : 0); };
}

/// A sensor's packets, stamped with the time at which they end.
const std::vector<Packet>& drive() {
  static const std::vector<Packet> packets = random_packets({.last_cdeg = 36'000 * kFrames + 1'500,
                                                             .first_stamp_ns = kStart_ns,
                                                             .share_of_returns = 0.05});
  return packets;
}

/// Of the vehicle, every kSamplePeriod_ns; of 0.4 s ago it is another one.
std::vector<can::CanFrame> bus(const Clock& clock) {
  std::vector<vehicle::MotionSample> samples;
  const std::int64_t end_ns = drive().back().stamp_ns + 100 * kMillisecond_ns;
  for (std::int64_t time_ns = kStart_ns - 100 * kMillisecond_ns + 3'300'000; time_ns < end_ns;
       time_ns += kSamplePeriod_ns) {
    const double t_s = static_cast<double>(time_ns - kStart_ns) * 1e-9;
    samples.push_back({time_ns, 20, 0.3 * std::sin(2 * std::numbers::pi * t_s / 1.6)});
  }
  std::vector<can::CanFrame> frames;
  const std::string log = drive::vehicle_log(samples);
  for (std::size_t begin = 0; begin < log.size();) {
    const std::size_t end = log.find('\n', begin);
    frames.push_back(
        can::parse_candump_line(std::string_view(log).substr(begin, end - begin))->frame);
    frames.back().stamp_ns = clock(frames.back().stamp_ns);
    begin = end + 1;
  }
  return frames;
}

vehicle::MotionSignals signals() {
  const auto file = vehicle::parse_dbc(drive::vehicle_dbc(), "vehicle.dbc");
  vehicle::MotionSignalsConfig config;
  config.speed.signals = {"SPEED"};
  config.yaw_rate.signals = {"YAW_RATE"};
  return *vehicle::MotionSignals::make(*file, config);
}

struct Arrival {
  std::int64_t time_ns = 0;
  Packet packet;
};

/// Every packet of the drive when it was sent.
std::vector<Arrival> in_time(const Clock& clock = right) {
  std::vector<Arrival> arrivals;
  for (const Packet& packet : drive()) {
    arrivals.push_back({packet.stamp_ns, packet});
    arrivals.back().packet.stamp_ns = clock(packet.stamp_ns);
  }
  return arrivals;
}

/// Decodes the packets with the CAN frames beside them, each half a millisecond after its time.
std::vector<Frame> decode(const std::vector<Arrival>& arrivals, const Clock& can_clock = right) {
  memory::FixedMemory memory;
  vehicle::EgoMotion motion({}, memory);
  vehicle::MotionSignals signals = test::signals();
  Recorder::Config config;
  config.columns = 521;
  config.returns_per_cell = 4;
  config.motion = &motion;
  config.deskew_at = frame::FrameInstant::kMiddle;
  Recorder recorder(config);
  const auto times = bus(right), frames = bus(can_clock);
  std::size_t next = 0;
  for (const Arrival& arrival : arrivals) {
    for (; next < frames.size() && times[next].stamp_ns + 500'000 <= arrival.time_ns; ++next) {
      if (const auto sample = signals.take(frames[next])) motion.add(*sample);
    }
    recorder.decode(arrival.packet);
  }
  recorder.flush();
  return std::move(recorder.frames);
}

/// The farthest that a return lies from where it lies in the other, by what is allowed: 2 ms of the
/// way, and what the motion changes in 20 ms.
double worst_share(const Frame& frame, const Frame& expected) {
  EXPECT_EQ(frame.returns.size(), expected.returns.size());
  double worst = 0;
  for (std::size_t i = 0; i < std::min(frame.returns.size(), expected.returns.size()); ++i) {
    const auto &a = frame.returns[i].point, &b = expected.returns[i].point;
    const double allowed_m = 0.05 + 0.004 * b.ground_range_m;
    worst = std::max(worst, std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) / allowed_m);
  }
  return worst;
}

/// Numbers of the frames that do not say that they are deskewed; those that do are as expected.
std::vector<std::uint32_t> not_deskewed(const std::vector<Frame>& frames,
                                        const std::vector<Frame>& expected) {
  std::vector<std::uint32_t> numbers;
  EXPECT_EQ(frames.size(), expected.size());
  for (std::size_t i = 0; i < std::min(frames.size(), expected.size()); ++i) {
    if (frames[i].info.deskew.state != DeskewState::kDone) {
      numbers.push_back(frames[i].info.number);
    } else {
      EXPECT_LT(worst_share(frames[i], expected[i]), 1.0) << "frame " << i;
    }
  }
  return numbers;
}

class MotionChain : public testing::Test {
 protected:
  static void SetUpTestSuite() { undisturbed() = decode(in_time()); }
  static std::vector<Frame>& undisturbed() {
    static std::vector<Frame> frames;
    return frames;
  }
};

/// Just before the packet in which the head is `share` of its way through a frame.
std::int64_t moment_ns(std::uint32_t frame, double share) {
  const double rotor_cdeg = (frame + share) * 36'000 - 34'900;
  const auto packet = static_cast<std::size_t>(std::llround(rotor_cdeg / (6 * 17.28)));
  return drive().at(packet).stamp_ns - 100'000;
}

TEST_F(MotionChain, DeskewsEveryFrame) {
  EXPECT_EQ(undisturbed().size(), static_cast<std::size_t>(kFrames + 1));
  EXPECT_TRUE(not_deskewed(undisturbed(), undisturbed()).empty());
}

TEST_F(MotionChain, AStepOfTheClockCostsTheFrameInWhichItFallsAndNoOther) {
  using Numbers = std::vector<std::uint32_t>;
  const auto expect_cost = [](std::int64_t step_ms, double share, std::int64_t apart_ms) {
    SCOPED_TRACE(fmt::format("{} ms at {}, the bus {} ms apart", step_ms, share, apart_ms));
    const std::int64_t at_ns = moment_ns(3, share), step_ns = step_ms * kMillisecond_ns;
    const auto frames = decode(in_time(stepping(at_ns, step_ns)),
                               stepping(at_ns + apart_ms * kMillisecond_ns, step_ns));
    EXPECT_EQ(not_deskewed(frames, undisturbed()), Numbers{3});
  };
  for (const std::int64_t size_ms : {25L, 99L, 101L, 400L, 5'000L, 3'600'000L, 40'000'000L}) {
    for (const std::int64_t step_ms : {-size_ms, size_ms}) {
      for (const double share : {0.1, 0.5, 0.93}) expect_cost(step_ms, share, 0);
      // The bus may be heard a little sooner or later than the packets.
      for (const std::int64_t apart_ms : {-4, 4}) expect_cost(step_ms, 0.93, apart_ms);
    }
  }
}

TEST_F(MotionChain, AStepWhereTwoFramesAreOpenCostsThoseTwo) {
  for (const std::int64_t step_ms : {-5'000L, -60L, 60L, 5'000L}) {
    for (const double share : {-0.02, -0.001, 0.001, 0.02, 0.03, 0.04}) {
      SCOPED_TRACE(fmt::format("{} ms at {}", step_ms, share));
      const std::int64_t at_ns = moment_ns(3, share);
      const Clock clock = stepping(at_ns, step_ms * kMillisecond_ns);
      for (const std::uint32_t number :
           not_deskewed(decode(in_time(clock), clock), undisturbed())) {
        EXPECT_TRUE(number == 2 || number == 3) << number;
      }
    }
  }
}

TEST_F(MotionChain, StepsBelowTheDisorderOfTheWayCostOneFrameAtMost) {
  for (const std::int64_t step_ms : {-20, -19, -11, -6, -4, -1, 1, 4, 11, 19, 20}) {
    SCOPED_TRACE(fmt::format("{} ms", step_ms));
    const Clock clock = stepping(moment_ns(3, 0.5), step_ms * kMillisecond_ns);
    EXPECT_LE(not_deskewed(decode(in_time(clock), clock), undisturbed()).size(), 1U);
  }
}

TEST_F(MotionChain, AStepOfOneClockAloneNeverMakesAFrameSayWhatIsNotSo) {
  for (const std::int64_t step_ms : {-700L, -150L, -60L, 60L, 150L, 700L}) {
    SCOPED_TRACE(fmt::format("{} ms", step_ms));
    const Clock clock = stepping(moment_ns(3, 0.5), step_ms * kMillisecond_ns);
    // What is left of the drive is on two clocks; how far they are apart is in every frame's
    // report.
    const auto packets_alone = decode(in_time(clock));
    const auto bus_alone = decode(in_time(), clock);
    for (const auto* frames : {&packets_alone, &bus_alone}) {
      for (std::size_t i = 0; i < frames->size(); ++i) {
        const frame::DeskewInfo& deskew = (*frames)[i].info.deskew;
        if (deskew.state != DeskewState::kDone || i < 3) continue;
        EXPECT_GT(std::abs(deskew.newest_motion_ns), 30 * kMillisecond_ns) << i;
      }
    }
  }
}

TEST_F(MotionChain, BeginsAnewAfterAnOutage) {
  auto arrivals = in_time();
  // 1.5 s of packets are lost; what the head does meanwhile nobody knows.
  constexpr std::int64_t kOutage_ns = 1'500 * kMillisecond_ns;
  const auto is_behind = [](std::int64_t time_ns) { return time_ns > moment_ns(3, 0.3); };
  std::vector<Arrival> longer;
  for (const Arrival& arrival : arrivals) {
    longer.push_back(arrival);
    if (!is_behind(arrival.time_ns)) continue;
    longer.back().packet.stamp_ns += kOutage_ns;
    longer.back().packet.set_device_stamp_us(
        static_cast<std::uint32_t>((arrival.packet.stamp_ns + kOutage_ns) / 1'000 % 3'600'000'000));
  }
  // Beside the later packets the vehicle moves as it did beside them without the outage.
  const Clock later = [&](std::int64_t time_ns) {
    return time_ns + (is_behind(time_ns) ? kOutage_ns : 0);
  };
  const auto frames = decode(longer, later);
  ASSERT_EQ(frames.size(), undisturbed().size() + 1) << "frame 3 is two: before and behind";
  for (std::size_t i = 5; i + 1 < frames.size(); ++i) {
    EXPECT_EQ(frames[i].info.deskew.state, DeskewState::kDone) << i;
    EXPECT_LT(worst_share(frames[i], undisturbed()[i - 1]), 1.0) << i;
    EXPECT_LT(std::abs(frames[i].info.deskew.newest_motion_ns), 20 * kMillisecond_ns) << i;
  }
}

TEST_F(MotionChain, APartOfAFrameBeforeALongGapIsDeskewedAsWithoutTheGap) {
  for (const std::int64_t gap_ms : {30, 150, 320, 520}) {
    SCOPED_TRACE(fmt::format("{} ms", gap_ms));
    const std::int64_t from_ns = moment_ns(2, 0.6);
    auto arrivals = in_time();
    std::erase_if(arrivals, [&](const Arrival& arrival) {
      return arrival.time_ns >= from_ns && arrival.time_ns < from_ns + gap_ms * kMillisecond_ns;
    });
    const auto frames = decode(arrivals);
    ASSERT_GE(frames.size(), 3U);
    // Returns come in the order of packets, so those before the gap have the same numbers.
    for (const std::size_t i : {1U, 2U}) {
      ASSERT_EQ(frames[i].info.deskew.state, DeskewState::kDone);
      Frame before = undisturbed()[i];
      Frame seen = frames[i];
      const std::size_t count = before.returns.size() / 2;
      before.returns.resize(count);
      seen.returns.resize(count);
      EXPECT_LT(worst_share(seen, before), 1.0) << i;
      EXPECT_NEAR(static_cast<double>(frames[i].info.deskew.reference_ns -
                                      undisturbed()[i].info.deskew.reference_ns),
                  0, 20'000);
    }
  }
}

TEST_F(MotionChain, PacketsThatAreHeldUpCostTheirFramesButNoneSaysWhatIsNotSo) {
  for (const std::int64_t held_ms : {3, 15, 40, 90, 250}) {
    SCOPED_TRACE(fmt::format("{} ms", held_ms));
    const std::int64_t from_ns = moment_ns(3, 0.5);
    auto arrivals = in_time();
    for (Arrival& arrival : arrivals) {
      const std::int64_t free_ns = from_ns + held_ms * kMillisecond_ns;
      if (arrival.time_ns < from_ns || arrival.time_ns >= free_ns) continue;
      arrival.time_ns = arrival.packet.stamp_ns = free_ns;
    }
    const auto lost = not_deskewed(decode(arrivals), undisturbed());
    EXPECT_LE(lost.size(), static_cast<std::size_t>(held_ms / 100 + 2));
    if (held_ms < 20) {
      EXPECT_TRUE(lost.empty());
    }
  }
}

TEST_F(MotionChain, PacketsThatWereOvertakenLeaveInstantsAsTheyAre) {
  auto arrivals = in_time();
  for (std::size_t i = 0; i < arrivals.size(); ++i) {  // jitter up to 4 ms, every 20th in time
    arrivals[i].packet.stamp_ns +=
        i % 20 == 0 ? 0 : static_cast<std::int64_t>(i * 7919 % 4000) * 1000;
  }
  const auto ordered = decode(arrivals);
  for (std::size_t i = 103; i + 1 < arrivals.size(); i += 7) {
    std::swap(arrivals[i].packet, arrivals[i + 1].packet);
    arrivals[i + 1].packet.stamp_ns = arrivals[i].packet.stamp_ns + 10'000;
  }
  const auto frames = decode(arrivals);
  ASSERT_EQ(frames.size(), ordered.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].info.deskew.state, DeskewState::kDone) << i;
    EXPECT_NEAR(static_cast<double>(frames[i].info.deskew.reference_ns -
                                    ordered[i].info.deskew.reference_ns),
                0, 30'000)
        << i;
  }
}

TEST_F(MotionChain, AClockThatIsSlewedDoesNotStep) {
  for (const double rate : {500e-6, -500e-6}) {
    const Clock clock = [rate](std::int64_t time_ns) {
      return time_ns + std::llround(static_cast<double>(time_ns - kStart_ns) * rate);
    };
    EXPECT_TRUE(not_deskewed(decode(in_time(clock), clock), undisturbed()).empty());
  }
}

}  // namespace
}  // namespace terracut::test
