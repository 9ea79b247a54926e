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

/// What a packet is to the stream it arrived in.
enum class Arrival : std::uint8_t {
  kNext,       ///< It goes on where the stream stands, perhaps behind a gap.
  kReordered,  ///< An older packet than the newest seen.
  kRestart,    ///< Nothing before it belongs with it: the first one, a long outage.
  kDoubtful,   ///< It contradicts the stream; the caller keeps it until it is known who is right.
  kNewStream,  ///< It and the doubtful ones before it agree: begin() with one of them.
  kRejected,   ///< Not to be decoded.
};

struct Placement {
  Arrival arrival = Arrival::kRejected;
  frame::Reject reject =
      frame::Reject::kCount;  ///< The reason when kRejected; of a doubtful one, if need be.
  /// Unwrapped azimuth of the first column; while in doubt, from that of the first in doubt on.
  std::int64_t rotor_cdeg = 0;
  /// Between this packet and the newest before it: packets that did not come, by the stamps, and
  /// packets that did and were rejected.
  std::int64_t missing = 0, explained = 0;
  bool is_first_in_doubt = false;  ///< kDoubtful, and those kept before do not agree with it.
};

/// Puts the packets of one spinning sensor into order by their device stamps and azimuths, and
/// counts those that are missing. Sensor independent.
///
/// The device's clock and the head's angle check each other: from the newest packet's angle, its
/// speed and the time since, the tracker knows within some degrees where the head must be, and
/// unwraps the azimuth to the frame nearest to that. So neither a lost half revolution nor a step
/// back starts a false frame. A packet that contradicts the stream by its stamp or its angle is in
/// doubt: when as many as kNewStream_packets have come in a row that agree with each other, and
/// none that agrees with the stream, it was the beginning of another one (a reboot, a loop of a
/// replay); otherwise those in doubt were strays, and have cost nothing. Missing packets follow
/// from the device stamps, which advance by a constant period: measured from the stream itself, and
/// the model's own until that is done or where what is measured is no unit's. Fixed memory; every
/// call O(1), noexcept. One thread.
class StreamTracker {
 public:
  static constexpr int kNewStream_packets = 32;

  /// `clock_wrap_us`: the device clock counts [0, clock_wrap_us).
  StreamTracker(std::int64_t clock_wrap_us, memory::FixedMemory& memory);

  /// Where this packet belongs. Clock jumps go to `losses`; the caller counts the rejection, and
  /// says how many of the missing packets were to come. `host_stamp_ns` is the datagram's, used
  /// only to tell an outage from a jump.
  [[nodiscard]] Placement place(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// After kNewStream, with each of the packets kept, in order, and with the last one itself: the
  /// first begins the stream. As place(), but nothing is in doubt any more.
  [[nodiscard]] Placement begin(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] Placement go_on(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Of the packets missing before the one just placed (kNext, kRestart) these are lost; counted
  /// some packets later unless they come out of order. To be called for each such packet.
  void miss(std::int64_t packets, frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// A packet with this stamp arrived but was rejected before place(): it is not missing.
  void note_rejected(std::int64_t device_stamp_us) noexcept TERRACUT_NONBLOCKING;
  /// The head stands still at this azimuth.
  void note_stationary(std::int64_t device_stamp_us, std::int32_t azimuth_cdeg,
                       frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Counts what is still thought to be on its way, and resets the stream (but not its period).
  void end_of_stream(frame::LossCounters& losses) noexcept TERRACUT_NONBLOCKING;

  /// Device time from packet to packet, nanoseconds, within the model's range (PacketAzimuths); 0
  /// until enough packets have been seen.
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }

 private:
  struct Seen {
    std::uint32_t stamp_us = 0;
    std::uint16_t first_cdeg = 0, last_cdeg = 0;
    std::uint32_t packet = 0;  ///< Number of the packet, from 1; 0 = never used.
  };

  /// From one packet that was taken to the next.
  struct Step {
    std::int64_t us = 0, explained = 0;
  };

  /// Where a stream stands.
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
  /// A packet that was taken. Those in doubt are not: who foretells a packet must not replace it.
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
                                 frame::LossCounters& losses) noexcept;
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
  Newest doubtful_;           ///< Of the packets that contradict the stream and agree ...
  int doubtful_packets_ = 0;  ///< ... so many in a row.

  std::int64_t nominal_period_ns_ = 1, shortest_period_ns_ = 1, longest_period_ns_ = 1;
  std::int64_t period_ns_ = 0;  ///< Measured, in the range above; 0 while it is not.
  std::int64_t averaged_us_ = 0, averaged_steps_ = 0;
  std::array<Step, kPeriodSamples> to_measure_{};
  std::size_t steps_ = 0;
  std::int64_t explained_ = 0;  ///< Packets since the newest that arrived but were rejected.
  /// Not here, but may still come out of order. While the period is being measured, below 0: those
  /// that have come out of order are known before those that are missing.
  std::int64_t missing_ = 0;
  int packets_since_missing_ = 0;
  int off_period_ = 0;  ///< Steps in a row that are no multiple of the period.
};

}  // namespace terracut::decode
