// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// How a packet relates to the stream it arrived in.
enum class Arrival : std::uint8_t {
  kNext,       ///< The packet continues the stream, perhaps after a gap.
  kReordered,  ///< The packet is older than the newest seen.
  kRestart,    ///< The packet begins a stream: the first, or the first after a long outage.
  kDoubtful,   ///< The packet contradicts the stream; the caller keeps it until that is decided.
  /// It agrees with the doubtful packets before it: call begin() with the first of them.
  kNewStream,
  kRejected,  ///< The packet is not to be decoded.
};

struct Placement {
  Arrival arrival = Arrival::kRejected;
  frame::Reject reject = frame::Reject::kCount;  ///< Why the packet is rejected, also after doubt.
  /// Unwrapped azimuth of the packet's first column; while in doubt, counted from the first
  /// doubtful packet.
  std::int64_t rotor_cdeg = 0;
  /// How many packets are missing by the stamps between this packet and the newest before it, and
  /// how many came in between but were rejected.
  std::int64_t missing = 0, explained = 0;
  /// True if kDoubtful and the packet does not agree with the doubtful packets kept before.
  bool is_first_in_doubt = false;
};

/// Puts the packets of one spinning sensor into order by their device stamps and azimuths, and
/// counts those that are missing. Independent of the sensor.
///
/// The device's clock and the head's angle check each other: from the newest packet's angle, the
/// head's speed and the time since, the tracker knows within some degrees where the head must be,
/// and unwraps the azimuth to the nearest frame. So neither a lost half revolution nor a step back
/// starts a false frame. A packet whose stamp or angle contradicts the stream is in doubt. If
/// kNewStream_packets in a row agree with each other but not with the stream, they begin another
/// stream (a reboot, a loop of a replay); otherwise they were strays and do no harm. Missing
/// packets follow from the device stamps, which advance by a constant period. The period is
/// measured from the stream; until then, and if the measurement fits no unit, the model's own is
/// used. Fixed memory; every call O(1), noexcept. One thread.
class StreamTracker {
 public:
  static constexpr int kNewStream_packets = 32;

  /// `clock_wrap_us` says where the device clock wraps: it counts [0, clock_wrap_us).
  StreamTracker(std::int64_t clock_wrap_us, memory::FixedMemory& memory);

  /// Places a packet and counts clock jumps in `losses`. The caller counts a rejection, and calls
  /// miss() with how many of the missing packets were expected. `host_stamp_ns` is the datagram's
  /// stamp, used only to tell an outage from a jump. `next_cdeg` is the unwrapped azimuth where a
  /// packet without a gap before it begins: behind the blind sector, if that is next.
  [[nodiscard]] Placement place(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                std::int64_t next_cdeg,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// To be called after kNewStream: begin() takes the first of the kept packets, go_on() each later
  /// one, the kNewStream packet last. Both place packets as place() does, but never as doubtful.
  [[nodiscard]] Placement begin(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] Placement go_on(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                std::int64_t next_cdeg,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Counts `packets` of those missing before the packet just placed (kNext, kRestart) as lost.
  /// Counting is delayed by some packets, in case they come out of order. To be called for each
  /// such packet.
  void miss(std::int64_t packets, frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Notes that a packet with this stamp arrived but was rejected before place(), so that it does
  /// not count as missing.
  void note_rejected(std::int64_t device_stamp_us) noexcept TERRACUT_NONBLOCKING;
  /// Notes that the head stands still at `azimuth_cdeg`.
  void note_stationary(std::int64_t device_stamp_us, std::int32_t azimuth_cdeg,
                       frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Counts packets still expected as lost and resets the stream, but not its period.
  void end_of_stream(frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Returns the device time from packet to packet, nanoseconds, within the model's range
  /// (PacketAzimuths); 0 until enough packets have been seen.
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }

 private:
  struct Seen {
    std::uint32_t stamp_us = 0;
    std::uint16_t first_cdeg = 0, last_cdeg = 0;
    std::uint32_t packet = 0;  ///< Number of the packet, from 1; 0 if the entry was never used.
  };

  /// The step from one accepted packet to the next.
  struct Step {
    std::int64_t us = 0, explained = 0;
  };

  /// The newest packet of a stream.
  struct Newest {
    std::int64_t stamp_us = 0, host_ns = 0, rotor_cdeg = 0;
    std::int32_t pace_ticks = 0;
  };

  static constexpr std::size_t kPeriodSamples = 15;

  [[nodiscard]] std::int64_t device_step_us(std::int64_t from_us,
                                            std::int64_t to_us) const noexcept {
    return packet::clock_step_us(from_us, to_us, clock_wrap_us_);
  }
  [[nodiscard]] static Seen seen(const packet::PacketAzimuths& azimuths) noexcept;
  [[nodiscard]] static std::size_t slot_of(const packet::PacketAzimuths& azimuths) noexcept;
  [[nodiscard]] bool is_repeat(const packet::PacketAzimuths& azimuths) const noexcept;
  /// Remembers an accepted packet, to recognise repeats. Doubtful packets are not remembered: a
  /// forged copy sent ahead must not make the real packet a repeat.
  void remember(const packet::PacketAzimuths& azimuths) noexcept;
  void adopt_range(const packet::PacketAzimuths& azimuths, frame::LossCounters& losses) noexcept;
  [[nodiscard]] std::int64_t period_in_use_ns() const noexcept {
    return period_ns_ != 0 ? period_ns_ : nominal_period_ns_;
  }
  void measure_period(std::int64_t step_us, frame::LossCounters& losses) noexcept;
  void average_in(std::int64_t step_us) noexcept;
  void fix_period(frame::LossCounters& losses) noexcept;
  void accept_median() noexcept;
  [[nodiscard]] std::int64_t missing_in(const Step& step) const noexcept;
  void commit_missing(frame::LossCounters& losses) noexcept;
  [[nodiscard]] Placement follow(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                 std::int64_t next_cdeg, frame::LossCounters& losses) noexcept;
  [[nodiscard]] std::optional<std::int64_t> head_after(
      const Newest& newest, const packet::PacketAzimuths& azimuths) const noexcept;
  [[nodiscard]] Placement doubt(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                frame::Reject reason) noexcept;
  [[nodiscard]] Placement restart(const packet::PacketAzimuths& azimuths,
                                  std::int64_t host_stamp_ns, frame::LossCounters& losses) noexcept;
  void take_as_newest(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                      std::int64_t rotor_cdeg, frame::LossCounters& losses) noexcept;

  std::int64_t clock_wrap_us_;
  std::span<Seen> seen_;
  std::uint32_t packets_ = 0;

  bool started_ = false;
  Newest newest_;
  Newest doubtful_;           ///< The newest of the packets in doubt, which agree with each other.
  int doubtful_packets_ = 0;  ///< Number of packets in doubt in a row.

  std::int64_t nominal_period_ns_ = 1, shortest_period_ns_ = 1, longest_period_ns_ = 1;
  std::int64_t period_ns_ = 0;  ///< The measured period, in the range above; 0 if not measured yet.
  std::int64_t averaged_us_ = 0, averaged_steps_ = 0;
  std::array<Step, kPeriodSamples> to_measure_{};
  std::size_t steps_ = 0;
  std::int64_t explained_ = 0;  ///< Packets since the newest that arrived but were rejected.
  /// Missing packets that may still come out of order. May be negative while the period is
  /// measured, since reordered packets are counted before the missing ones are known.
  std::int64_t missing_ = 0;
  int packets_since_missing_ = 0;
  int off_period_ = 0;  ///< Number of steps in a row that are no multiple of the period.
};

}  // namespace terracut::decode
