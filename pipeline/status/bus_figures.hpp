// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/status/named_count.hpp"
#include "rt/memory/fixed_text.hpp"

namespace terracut::status {

/// What is known of the vehicle's motion, and if it is not, why.
enum class MotionState : std::uint8_t {
  kNotAsked,
  kWaiting,        ///< No speed and yaw rate has come since the start.
  kKnown,          ///< They are coming.
  kLost,           ///< They came, but not lately.
  kBusOff,         ///< The CAN controller has taken itself off the bus.
  kInterfaceDown,  ///< The CAN interface is down ...
  kInterfaceGone,  ///< ... or not there.
  kCount,
};

/// Stable lower_snake_case name, as in reports; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(MotionState state) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(MotionState::kCount)> kNames{
      "not_asked", "waiting", "known", "lost", "bus_off", "interface_down", "interface_gone"};
  return state < MotionState::kCount ? kNames[static_cast<std::size_t>(state)] : "unknown";
}

/// The vehicle's motion in a live run: where it comes from, and in how many frames it was known. A
/// plain value, part of MonitorSnapshot.
struct MotionFigures {
  static constexpr std::size_t kMaxFaults = 24;

  memory::FixedText<16> bus;  ///< CAN interface; empty: the motion is not asked for.
  MotionState state = MotionState::kNotAsked;
  std::uint64_t samples = 0;        ///< Speed and yaw rate, whole and fresh.
  std::uint64_t spare_samples = 0;  ///< More of them than are of use; left out.
  std::int64_t last_sample_ns = 0;  ///< Kernel's stamp of the newest one; 0: none yet.

  std::uint64_t deskewed = 0;       ///< Frames, whatever their level.
  std::uint64_t no_ego_motion = 0;  ///< Frames that stayed as the sensor saw them.

  /// Stamp of the newest sample there was when a frame was handed over, less the instant of the
  /// frame's last firing: about 0 where both clocks are one. 0 where there was none.
  std::int64_t newest_sample_after_frame_ns = 0;  ///< Of the newest frame.
  /// Of the frames that were deskewed.
  std::int64_t least_sample_after_frame_ns = 0, most_sample_after_frame_ns = 0;
  double sum_sample_after_frame_ns = 0;

  std::uint32_t fault_count = 0;  ///< How many of `faults` are in use.
  std::array<NamedCount, kMaxFaults> faults{};

  [[nodiscard]] double mean_sample_after_frame_ns() const noexcept {
    return deskewed == 0 ? 0.0 : sum_sample_after_frame_ns / static_cast<double>(deskewed);
  }
  [[nodiscard]] std::span<const NamedCount> faults_in_use() const noexcept {
    return std::span(faults).first(std::min<std::size_t>(fault_count, faults.size()));
  }
};

/// What a live run said of itself on a CAN bus. A plain value, part of MonitorSnapshot.
struct HealthFigures {
  memory::FixedText<16> bus;     ///< CAN interface; empty: nothing is sent.
  std::uint64_t sent = 0;        ///< CAN frames.
  std::uint64_t queue_full = 0;  ///< Left out: the bus was too busy.
  std::uint64_t link_down = 0;   ///< Left out: the interface was down or gone.
  std::uint64_t failed = 0;      ///< Left out for another reason.
};

}  // namespace terracut::status
