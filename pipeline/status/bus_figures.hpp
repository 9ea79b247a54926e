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

/// Tells whether the vehicle's motion is known and, if not, why.
enum class MotionState : std::uint8_t {
  kNotAsked,
  kWaiting,        ///< No sample with speed and yaw rate has come yet.
  kKnown,          ///< Samples are coming.
  kLost,           ///< Samples came, but not recently.
  kBusOff,         ///< The CAN controller has taken itself off the bus.
  kInterfaceDown,  ///< The CAN interface is down.
  kInterfaceGone,  ///< The CAN interface is missing.
  kCount,
};

/// Returns a stable lower_snake_case name, as in reports; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(MotionState state) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(MotionState::kCount)> kNames{
      "not_asked", "waiting", "known", "lost", "bus_off", "interface_down", "interface_gone"};
  return state < MotionState::kCount ? kNames[static_cast<std::size_t>(state)] : "unknown";
}

/// The vehicle's motion in a live run: where it comes from, and in how many frames it was known. A
/// plain value, part of MonitorSnapshot.
struct MotionFigures {
  static constexpr std::size_t kMaxFaults = 24;

  memory::FixedText<16> bus;  ///< CAN interface; empty: motion is not used.
  MotionState state = MotionState::kNotAsked;
  std::uint64_t samples = 0;        ///< Samples with valid and recent speed and yaw rate.
  std::uint64_t spare_samples = 0;  ///< Samples left out, beyond the rate needed.
  std::int64_t last_sample_ns = 0;  ///< Kernel's stamp of the newest sample; 0: none yet.

  std::uint64_t deskewed = 0;       ///< Deskewed frames of any level.
  std::uint64_t no_ego_motion = 0;  ///< Frames not deskewed.

  /// Stamp of the newest sample at the hand-over of a frame, minus the instant of the frame's last
  /// firing: about 0 if both use one clock; 0 without a sample.
  std::int64_t newest_sample_after_frame_ns = 0;  ///< Of the newest frame.
  /// The least and the greatest newest_sample_after_frame_ns over all deskewed frames.
  std::int64_t least_sample_after_frame_ns = 0, most_sample_after_frame_ns = 0;
  double sum_sample_after_frame_ns = 0;

  std::uint32_t fault_count = 0;  ///< The number of `faults` in use.
  std::array<NamedCount, kMaxFaults> faults{};

  [[nodiscard]] double mean_sample_after_frame_ns() const noexcept {
    return deskewed == 0 ? 0.0 : sum_sample_after_frame_ns / static_cast<double>(deskewed);
  }
  [[nodiscard]] std::span<const NamedCount> faults_in_use() const noexcept {
    return std::span(faults).first(std::min<std::size_t>(fault_count, faults.size()));
  }
};

/// The state of sending health reports on a CAN bus. A plain value, part of MonitorSnapshot.
struct HealthFigures {
  memory::FixedText<16> bus;     ///< CAN interface; empty: no reports.
  std::uint64_t sent = 0;        ///< CAN frames sent.
  std::uint64_t queue_full = 0;  ///< CAN frames not sent: the bus was too busy.
  std::uint64_t link_down = 0;   ///< CAN frames not sent: the interface was down or missing.
  std::uint64_t failed = 0;      ///< CAN frames not sent for another reason.
};

}  // namespace terracut::status
