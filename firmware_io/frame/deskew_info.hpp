// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string_view>

namespace terracut::frame {

/// The instant of a frame at which all its returns are to lie where they were: when the head passes
/// straight ahead for the first time, behind, or straight ahead again.
enum class FrameInstant : std::uint8_t { kStart, kMiddle, kEnd };

enum class DeskewState : std::uint8_t {
  kOff,   ///< Not asked for: returns lie where the sensor saw them when it saw them.
  kDone,  ///< All returns lie where they were at one instant, if they stood still.
  /// Asked for, but the vehicle's motion is not known, or a clock was set while the frame arrived:
  /// as kOff.
  kNoEgoMotion,
};

/// Stable lower_snake_case name, as in reports.
[[nodiscard]] constexpr std::string_view to_string(DeskewState state) noexcept {
  switch (state) {
    case DeskewState::kOff:
      return "not_asked";
    case DeskewState::kDone:
      return "deskewed";
    case DeskewState::kNoEgoMotion:
      return "no_ego_motion";
  }
  return "unknown";
}

/// Where the sensor was in the ground plane, seen from where a journey began: p_journey = R p + t.
/// Places of one journey are known from each other; between two journeys motion was not known.
struct Place {
  std::uint32_t journey = 0;  ///< 1.. ; 0: the place is not known.
  double x_m = 0, y_m = 0;
  double cosine = 1, sine = 0;  ///< Of the heading.
};

/// Whether and how a frame was freed of the vehicle's motion.
struct DeskewInfo {
  DeskewState state = DeskewState::kOff;
  FrameInstant at = FrameInstant::kEnd;
  std::int64_t reference_ns = 0;  ///< That instant, on the clock of datagrams; not for kOff.
  /// Stamp of the newest motion known, less the instant of the frame's last firing; about 0 where
  /// both clocks are one. 0 without any motion.
  std::int64_t newest_motion_ns = 0;
  Place place;  ///< At that instant; known for kDone.
};

}  // namespace terracut::frame
