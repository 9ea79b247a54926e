// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Streams of CAN frames, bent, beside the packets of a rotating head, on one clock that is set now
// and then or on two: from signals to a deskewed frame. Whatever comes, places stay finite, every
// frame is accounted for, and a frame says that it is deskewed only where there was motion for it
// lately.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "firmware_io/decode/deskewer.hpp"
#include "firmware_io/decode/host_clock.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "input.hpp"
#include "tests/support/allocation_counter.hpp"

namespace {

using namespace terracut;
using fuzz::require;

constexpr std::string_view kCar = R"(BO_ 1 WHEELS: 8 X
 SG_ LEFT : 7|16@0- (0.01,0) [0|0] "km/h" X
 SG_ RIGHT : 16|16@1- (0.01,-5) [0|0] "km/h" X
 SG_ BACKWARDS : 48|1@1+ (1,0) [0|0] "" X
BO_ 2 YAW: 8 X
 SG_ RATE : 7|16@0- (0.01,0) [0|0] "deg/s" X
 SG_ RATE_SIGN : 16|1@1+ (1,0) [0|0] "" X
 SG_ RATE_VALID : 17|1@1+ (1,0) [0|0] "" X
BO_ 2147483651 FLOATS: 8 X
 SG_ SPEED : 0|32@1- (1,0) [0|0] "m/s" X
 SG_ TURN : 32|32@1- (1,0) [0|0] "rad/s" X
SIG_VALTYPE_ 2147483651 SPEED : 1;
SIG_VALTYPE_ 2147483651 TURN : 1;
)";
constexpr std::array kIds{can::CanId{1, false}, can::CanId{2, false}, can::CanId{3, true},
                          can::CanId{1, true}};
constexpr frame::ImageShape kShape{2, 64};
constexpr std::array<std::int32_t, 2> kBeam_ticks{-1'000'000, 500'000};
constexpr std::int64_t kMillisecond_ns = 1'000'000, kHour_us = 3'600'000'000;
/// A clock is not known better than that (host_clock.hpp, motion_sample.hpp): either of the two.
constexpr std::int64_t kDoubt_ns = 2 * vehicle::kMotionDisorder_ns;
constexpr int kMostSteps = 4'000;

vehicle::MotionSignals signals(unsigned bits) {
  static const vehicle::DbcFile file = *vehicle::parse_dbc(kCar, "car.dbc");
  vehicle::MotionSignalsConfig config;
  if ((bits & 1) != 0) {
    config.speed.signals = {"FLOATS.SPEED"};
    config.yaw_rate.signals = {"TURN"};
  } else {
    config.speed.signals = {"LEFT", "RIGHT"};
    config.yaw_rate.signals = {"RATE"};
    if ((bits & 2) != 0) config.speed.sign = "BACKWARDS";
    if ((bits & 4) != 0) config.yaw_rate.sign = "RATE_SIGN";
    if ((bits & 8) != 0) config.yaw_rate.valid = "RATE_VALID";
  }
  return *vehicle::MotionSignals::make(file, config);
}

class MotionRun {
 public:
  explicit MotionRun(fuzz::Input& input)
      : input_(input),
        bits_(input.next(1)),
        signals_(signals(bits_)),
        motion_({.sensor_ahead_m = (bits_ & 16) != 0 ? 2.0 : 0.0, .waiting = 16, .kept = 32},
                memory_),
        deskewer_({&motion_, static_cast<frame::FrameInstant>((bits_ >> 5) % 3), kShape,
                   packet::kRevolution_ticks},
                  kBeam_ticks, memory_) {}

  void run() {
    const std::size_t memory_bytes = memory_.total_bytes();
    const std::uint64_t allocations = test::allocations_of_this_thread();
    for (int step = 0; step < kMostSteps && !input_.empty(); ++step) bend();
    if (test::allocations_are_counted()) {
      require(test::allocations_of_this_thread() == allocations, "memory was allocated");
    }
    require(memory_.total_bytes() == memory_bytes, "memory was taken after the start");
    const vehicle::MotionCounters& counters = signals_.counters();
    require(counters.frames == frames_ && counters.samples == samples_, "frames are miscounted");
    const vehicle::EgoMotionCounters motion = motion_.counters();
    require(
        motion.accepted + motion.implausible + motion.out_of_order + motion.not_taken == samples_,
        "samples are not all accounted for");
  }

 private:
  void bend() {
    switch (input_.next(1) % 12) {
      case 0:
        packet();
        break;
      case 1:
      case 2:
        drive(1 + input_.below(256));
        break;
      case 3:
        frame();
        break;
      case 4:
        period_ns_ = (1 + input_.below(256)) * 500'000LL;
        break;
      case 5:
        speed_ = static_cast<std::int16_t>(input_.next(2));
        rate_ = static_cast<std::int16_t>(input_.next(2));
        break;
      case 6:  // the clock of both is set
        set(both_ns_);
        break;
      case 7:  // one clock alone is; from then on they are two
        set(input_.below(2) == 0 ? bus_ns_ : device_ns_);
        one_clock_ = false;
        break;
      case 8:  // silence of both
        time_ns_ += input_.below(256) * 10 * kMillisecond_ns;
        break;
      case 9:  // packets are lost, or the head begins anew
        if (input_.below(2) == 0) {
          rotor_ticks_ += std::int64_t{input_.below(256)} * 1'000'000;
        } else {
          hand_over();
          deskewer_.restart();
          clock_.reset();
          frame_ = rotor_ticks_ = 0;
          noted_ = false;
        }
        break;
      case 10:  // packets come late, as they may
        late_ns_ = input_.below(256) * 100'000LL;
        break;
      default:
        bus_is_heard_ = !bus_is_heard_;
        break;
    }
  }

  /// By 10 us to two months, either way.
  void set(std::int64_t& clock_ns) {
    static constexpr std::array<std::int64_t, 4> kUnits{10'000, 100'000, 10'000'000,
                                                        156'250'000'000};
    static constexpr std::int64_t kFarthest_ns = 800'000'000'000'000'000;
    const auto value = static_cast<std::int16_t>(input_.next(2));
    clock_ns = std::clamp(clock_ns + value * kUnits[static_cast<std::size_t>(input_.below(4))],
                          -kFarthest_ns, kFarthest_ns);
  }
  [[nodiscard]] std::int64_t host_ns() const { return time_ns_ + both_ns_; }

  /// Any frame, of this bus or not.
  void frame() {
    can::CanFrame frame;
    const unsigned bits = input_.next(1);
    frame.id = kIds[bits & 3];
    frame.remote = (bits & 4) != 0;
    frame.error = (bits & 8) != 0;
    frame.fd = (bits & 16) != 0;
    const auto bytes = input_.take((bits >> 5) + 1);
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    const auto disorder_ns = static_cast<std::int8_t>(input_.next(1)) * kMillisecond_ns;
    if (disorder_ns > 0) one_clock_ = false;  // it is stamped before its time
    hear(frame, disorder_ns);
  }

  void hear(can::CanFrame frame, std::int64_t late_ns) {
    frame.stamp_ns = host_ns() + bus_ns_ + late_ns;
    bool is_known = false;
    for (const can::CanId& id : signals_.ids()) is_known = is_known || id == frame.id;
    frames_ += is_known && frame.is_data() ? 1 : 0;
    const auto sample = signals_.take(frame);
    if (!sample) return;
    ++samples_;
    require(std::isfinite(sample->speed_mps) && std::isfinite(sample->yaw_rate_radps),
            "a sample is no number");
    require(sample->stamp_ns == frame.stamp_ns, "a sample is of another time than its frame");
    if (motion_.add(*sample)) newest_sample_ns_ = time_ns_;
  }

  void drive(int packets) {
    for (; packets > 0; --packets) {
      packet();
      if (time_ns_ < next_frames_ns_) continue;
      next_frames_ns_ = time_ns_ + period_ns_;
      if (bus_is_heard_) regular_frames();
    }
  }

  void regular_frames() {
    can::CanFrame wheels, yaw;
    wheels.id = kIds[0];
    yaw.id = kIds[1];
    if ((bits_ & 1) != 0) {
      wheels.id = kIds[2];
      const std::array<float, 2> floats{static_cast<float>(speed_) * 0.01F,
                                        static_cast<float>(rate_) * 0.001F};
      const auto bytes = std::as_bytes(std::span(floats));
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        wheels.data[i] = static_cast<std::uint8_t>(bytes[i]);
      }
    } else {
      const auto low = [](int value) { return static_cast<std::uint8_t>(value & 0xFF); };
      wheels.data = {low(speed_ >> 8), low(speed_), low(speed_), low(speed_ >> 8)};
      yaw.data = {low(rate_ >> 8), low(rate_), 2};
    }
    wheels.length = yaw.length = 8;
    hear(wheels, 0);
    if ((bits_ & 1) == 0) hear(yaw, 0);
  }

  /// A packet, 2 ms and 7 degrees after the one before.
  void packet() {
    time_ns_ += 2 * kMillisecond_ns;
    rotor_ticks_ += 700'000;
    const std::int64_t device_us = (time_ns_ + device_ns_) / 1'000 % kHour_us;
    const decode::HostClock::Sent sent =
        clock_.sent((device_us + kHour_us) % kHour_us, host_ns() + late_ns_);
    if (sent.anew) deskewer_.begin_anew(rotor_ticks_);
    deskewer_.note(rotor_ticks_, sent.instant_ns);
    if (!noted_) frame_ = rotor_ticks_ / packet::kRevolution_ticks;
    noted_ = true;
    packet_before_ns_ = std::exchange(newest_packet_ns_, time_ns_);
    while (rotor_ticks_ - (frame_ + 1) * packet::kRevolution_ticks > 1'000'000) hand_over();
  }

  void hand_over() {
    if (!noted_) return;
    const auto [info, motions] = deskewer_.deskew(frame_++);
    for (const frame::PlanarMotions& row : motions) {
      for (std::size_t column = 0; column < row.cosine.size(); ++column) {
        require(std::isfinite(row.cosine[column]) && std::isfinite(row.sine[column]) &&
                    std::isfinite(row.x_m[column]) && std::isfinite(row.y_m[column]),
                "a return is moved nowhere");
      }
    }
    if (info.state != frame::DeskewState::kDone) {
      require(info.state == frame::DeskewState::kNoEgoMotion && motions.empty(),
              "a frame moved by no motion");
      return;
    }
    require(motions.size() == static_cast<std::size_t>(kShape.rows), "rows are not moved");
    require(newest_sample_ns_.has_value(), "a frame moved without any sample");
    require(info.newest_motion_ns >= -kMaxAge_ns, "a frame was moved by old motion");
    // On one clock that also holds in the time that is never set.
    if (one_clock_) {
      require(packet_before_ns_ - *newest_sample_ns_ <= kMaxAge_ns + kDoubt_ns,
              "a frame was moved by motion of long ago");
    }
  }

  static constexpr std::int64_t kMaxAge_ns = 100 * kMillisecond_ns;

  fuzz::Input& input_;
  unsigned bits_;
  memory::FixedMemory memory_;
  vehicle::MotionSignals signals_;
  vehicle::EgoMotion motion_;
  decode::Deskewer deskewer_;
  decode::HostClock clock_{kHour_us};

  std::int64_t time_ns_ = 1'700'000'000'000'000'000;  ///< Never set.
  std::int64_t both_ns_ = 0, bus_ns_ = 0, device_ns_ = 0, late_ns_ = 0;
  std::int64_t newest_packet_ns_ = 0, packet_before_ns_ = 0;
  std::int64_t next_frames_ns_ = 0, period_ns_ = 10 * kMillisecond_ns;
  std::optional<std::int64_t> newest_sample_ns_;
  std::int64_t rotor_ticks_ = 0, frame_ = 0;
  int speed_ = 3'600, rate_ = 900;
  std::uint64_t frames_ = 0, samples_ = 0;
  bool noted_ = false, one_clock_ = true, bus_is_heard_ = true;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  MotionRun(input).run();
  return 0;
}
