// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "firmware_io/decode/blind_sector.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/rotor_sector.hpp"

namespace terracut::sensor {

enum class ReturnMode : std::uint8_t { kUnknown, kSingle, kDual };
[[nodiscard]] std::string_view to_string(ReturnMode mode) noexcept;

/// How a sensor's head rotated and which packets were lost, by the device's own stamps and
/// azimuths.
struct StreamFacts {
  std::uint64_t packets = 0;
  ReturnMode return_mode = ReturnMode::kUnknown;
  double packet_period_us = 0;  ///< Mean device time between packets; 0 while unknown.
  double spin_rpm = 0;          ///< 0 for a head that stands still.
  double step_deg = 0;          ///< Mean azimuth from one firing to the next.
  double frames = 0;            ///< Revolutions from the first packet to the last, gaps included.
  /// Packets missing by the device stamps, outside a blind sector.
  std::uint64_t packets_lost = 0;
  frame::BlindAzimuths blind;          ///< Where the sensor is blind, as known at the end.
  std::uint64_t packets_repeated = 0;  ///< Packets with the same stamp as the packet before.
  std::uint64_t packets_reordered = 0;
  std::uint64_t clock_jumps = 0;  ///< Stamp steps beyond 10 s either way: a loop, a restart.
  std::uint64_t azimuths_out_of_range = 0;  ///< Packets with an azimuth of 360 degrees or more.
};

/// Gathers StreamFacts packet by packet. For inspection, not for the receive thread: allocates.
class StreamSurvey {
 public:
  /// `clock_wrap_us` says where the device clock wraps: it counts [0, clock_wrap_us).
  explicit StreamSurvey(std::int64_t clock_wrap_us) : clock_wrap_us_(clock_wrap_us) {}

  /// Adds a packet. `rotating` says that all of `azimuths` is valid; otherwise (the head does not
  /// rotate) only its stamp and column azimuths are.
  void add(const packet::PacketAzimuths& azimuths, bool rotating);
  /// Adds a packet whose azimuths are all invalid.
  void add_out_of_range() {
    ++facts_.packets;
    ++facts_.azimuths_out_of_range;
  }
  /// Returns where the sensor is blind, as far as learnt.
  [[nodiscard]] const decode::BlindSector& blind() const noexcept { return blind_; }
  [[nodiscard]] StreamFacts facts() const;

 private:
  /// The newest packet of a rotating head, by unwrapped azimuth.
  struct Seen {
    std::int64_t stamp_us = 0, rotor_cdeg = 0;
    bool has_sector = false;  ///< True if a blind sector lies in the packet (PacketAzimuths).
  };

  /// Adds the device time and azimuth between two adjacent packets of the capture.
  void add_step(const packet::PacketAzimuths& azimuths, bool rotating);
  /// Follows a rotating head over the time `step_us` to this packet. True if the azimuths tell what
  /// was lost in between.
  [[nodiscard]] bool follow(const packet::PacketAzimuths& azimuths, std::int64_t step_us);
  void begin_rotating(const packet::PacketAzimuths& azimuths);
  [[nodiscard]] double period_us() const;

  std::int64_t clock_wrap_us_;
  StreamFacts facts_;
  std::optional<packet::PacketAzimuths> newest_;
  std::map<std::int64_t, std::uint64_t> steps_us_;  ///< Stamp steps, with how often each occurred.
  std::int64_t short_time_us_ = 0;  ///< Sum over steps short enough to tell the azimuth's advance.
  std::int64_t short_advance_cdeg_ = 0;
  std::int64_t long_time_us_ = 0;  ///< Sum over all other steps.
  decode::BlindSector blind_{packet::kRevolution_ticks};
  std::optional<Seen> seen_;
  std::int64_t frontier_ticks_ = 0;  ///< Azimuth up to which the head was seen.
  /// Packets without rotation since the head was last seen rotating.
  std::int64_t not_rotating_ = 0;
  std::int64_t lost_in_gaps_ = 0;  ///< Packets lost in gaps wide enough for a blind sector.
  std::int64_t steps_ticks_ = 0;   ///< Sum of the packets' own steps.
  std::uint64_t dual_packets_ = 0;
  std::uint64_t rotating_packets_ = 0;
};

}  // namespace terracut::sensor
