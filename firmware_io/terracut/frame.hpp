// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "terracut/free_way.hpp"
#include "terracut/object.hpp"

namespace terracut {

/// The label of a return.
enum class Label : std::uint8_t {
  kNone = 0,         ///< The point is no return (clouds only), or the frame was not labelled.
  kGround = 1,       ///< Physical ground; only road surface, if that was asked for.
  kObstacle = 2,     ///< Any return that is not ground.
  kOtherGround = 3,  ///< Physical ground that is not road surface.
};

/// True for physical ground of either kind.
[[nodiscard]] constexpr bool is_ground(Label label) noexcept {
  return label == Label::kGround || label == Label::kOtherGround;
}

/// One return in the vehicle frame (calibration.hpp): x ahead, y left, z up from the ground below
/// the sensor.
struct Point {
  float x_m = 0, y_m = 0, z_m = 0;
  std::uint16_t ring = 0;      ///< Row of the laser in the range image; 0 is the lowest.
  std::uint8_t intensity = 0;  ///< Intensity as the sensor sends it.
};

/// A point of a cloud in the sensor frame: x ahead, y left, z up.
struct CloudPoint {
  float x_m = 0, y_m = 0, z_m = 0;
  float remission = 0;  ///< Reflectivity, 0 to 1.
};

/// One revolution of the sensor. points and labels have one entry per return, in order of arrival.
/// The function that hands the frame out says how long they are valid.
struct Frame {
  std::uint32_t number = 0;  ///< Number of the frame, from 0, in order.
  /// Stamp of the frame's first packet, nanoseconds since 1970 (UTC).
  std::int64_t first_packet_ns = 0;
  std::int64_t last_packet_ns = 0;
  bool complete = false;  ///< True if every firing was seen, except where the sensor is blind.
  bool deskewed = false;  ///< True if the vehicle's motion was removed.
  std::uint64_t packets_lost = 0;  ///< Packets lost on the network since the last frame.
  std::span<const Point> points;
  std::span<const Label> labels;  ///< Empty if the frame was not labelled.
  /// Time of each return since the first packet; empty except from a LiveRun.
  std::span<const float> time_s = {};
  /// Height of each return above the ground found below it, which need not be level; finite. Empty
  /// unless asked for (Config::heights).
  std::span<const float> height_above_ground_m = {};
  /// Objects of obstacle returns, and the number of each return's object (0: none; object i has the
  /// number i + 1); empty unless asked for.
  std::span<const Object> objects = {};
  std::span<const std::uint16_t> object_of_return = {};
  /// The free way by direction, clockwise; the first sector begins straight ahead. Empty unless
  /// asked for.
  std::span<const FreeWaySector> free_way = {};
};

/// An object found while the sensor turns. Where one turn ends and the next begins it has returns
/// of both, unlike the objects of a frame.
struct CompleteObject {
  Object object;            ///< Its returns are numbered as in `frame`; those of that frame alone.
  std::uint32_t frame = 0;  ///< The frame with its last return.
  /// Stamp of the first packet of the sector with its last return.
  std::int64_t last_packet_ns = 0;
};

/// Some four degrees of a revolution, labelled while the sensor turns on: the returns of successive
/// firings. points and labels have one entry per return, in order of arrival.
struct Sector {
  std::uint32_t frame = 0;           ///< Number of the frame that it is part of.
  std::size_t first_return = 0;      ///< Index of its first return in that frame.
  std::int64_t first_packet_ns = 0;  ///< Stamps of the packets with its first and last firing,
  std::int64_t last_packet_ns = 0;   ///< nanoseconds since 1970 (UTC).
  std::int64_t labelled_ns = 0;      ///< When its labels were known.
  std::span<const Point> points;
  std::span<const Label> labels;
  std::span<const float> height_above_ground_m = {};  ///< As in Frame.
  /// Objects that are complete since this sector: no later return is near enough to belong to them.
  /// Empty unless asked for.
  std::span<const CompleteObject> objects = {};
};

}  // namespace terracut
