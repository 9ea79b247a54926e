// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace terracut::frame {

/// The instant at which deskewing places a frame's returns: when the head passes straight ahead for
/// the first time (start), straight behind (middle), or straight ahead again (end).
enum class FrameInstant : std::uint8_t { kStart, kMiddle, kEnd };

enum class DeskewState : std::uint8_t {
  kOff,   ///< Deskewing was not asked for: every return lies where the sensor saw it.
  kDone,  ///< All returns lie where static objects were at one instant.
  /// Deskewing was asked for but not done: the vehicle's motion is unknown, or a clock was set
  /// while the frame arrived.
  kNoEgoMotion,
};

/// Returns a stable lower_snake_case name, used in reports.
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

/// Rigid motions in the ground plane, one per column: x' = c x - s y + t_x, y' = s x + c y + t_y. A
/// frame is deskewed by one of these for each row.
struct PlanarMotions {
  std::span<const float> cosine, sine, x_m, y_m;
};

/// A rigid motion in the ground plane: x' = c x - s y + t_x, y' = s x + c y + t_y.
struct PlanarMotion {
  float cosine = 1, sine = 0, x_m = 0, y_m = 0;
};

/// Whether and how the vehicle's motion was removed from a frame.
struct DeskewInfo {
  /// How points that were measured at an instant of the datagrams' clock were moved.
  struct Moved {
    std::int64_t measured_ns = 0;
    PlanarMotion by;
  };

  DeskewState state = DeskewState::kOff;
  FrameInstant at = FrameInstant::kEnd;
  /// Time of the instant `at`, on the datagrams' clock; unset for kOff.
  std::int64_t reference_ns = 0;
  /// Stamp of the newest motion sample minus the instant of the frame's last firing; about 0 if
  /// both use one clock. 0 if there is no sample.
  std::int64_t newest_motion_ns = 0;
  /// For kDone: of points measured about the frame's begin, middle and end. Parabolas through these
  /// tell the motions between to a millimetre, of a vehicle with 20 m/s in a curve of 0.4 rad/s.
  std::array<Moved, 3> moved{};
};

}  // namespace terracut::frame
