// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace terracut {

/// What is said of a return.
enum class Label : std::uint8_t {
  kNone = 0,         ///< A point that is no return (clouds only), or a frame that was not labelled.
  kGround = 1,       ///< Physical ground; road surface, where that is asked for.
  kObstacle = 2,     ///< Everything else.
  kOtherGround = 3,  ///< Physical ground that is no road surface.
};

/// Physical ground of either kind.
[[nodiscard]] constexpr bool is_ground(Label label) noexcept {
  return label == Label::kGround || label == Label::kOtherGround;
}

/// One return in the vehicle frame (calibration.hpp): x ahead, y left, z up from the ground below
/// the sensor.
struct Point {
  float x_m = 0, y_m = 0, z_m = 0;
  std::uint16_t ring = 0;      ///< 0 is the lowest laser.
  std::uint8_t intensity = 0;  ///< As the sensor sends it.
};

/// A point of a cloud in the sensor frame: x ahead, y left, z up.
struct CloudPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float remission = 0;  ///< 0..1
};

/// One revolution of the sensor. points and labels have one entry a return, in order of arrival,
/// and are valid as long as whoever handed the frame out says.
struct Frame {
  std::uint32_t number = 0;          ///< 0.. in order.
  std::int64_t first_packet_ns = 0;  ///< Receive stamp, nanoseconds since 1970 (UTC).
  std::int64_t last_packet_ns = 0;
  bool complete = false;  ///< Every firing was seen; where the sensor is blind, none is missing.
  bool deskewed = false;  ///< The vehicle's motion was removed.
  std::uint64_t packets_lost = 0;  ///< On the network, since the frame before.
  std::span<const Point> points;
  std::span<const Label> labels;       ///< Empty where the frame was not labelled.
  std::span<const float> time_s = {};  ///< After the first packet; empty but of a LiveRun.
};

}  // namespace terracut
