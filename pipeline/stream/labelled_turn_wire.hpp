// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "firmware_io/sensor/sensor_model.hpp"
#include "pipeline/status/frame_timing.hpp"
#include "rt/error.hpp"

/// A labelled turn as it goes over a socket (docs/reference/labelled_stream.md): one header, then
/// the points, then the next turn's header. Little-endian, without padding, used as it lies.
namespace terracut::stream {

static_assert(std::endian::native == std::endian::little, "the records below are sent as they lie");

/// One return. `label` is the SemanticKITTI class as in the .label files (label_sink.hpp); `row`
/// that of the range image, 0 is the lowest laser.
struct LabelledPoint {
  float x_m = 0, y_m = 0, z_m = 0;  ///< Vehicle frame (calib/mount/mount.hpp).
  std::uint8_t intensity = 0;
  std::uint8_t label = 0;
  std::uint16_t row = 0;

  bool operator==(const LabelledPoint&) const = default;
};
static_assert(sizeof(LabelledPoint) == 16 && std::is_trivially_copyable_v<LabelledPoint>);
static_assert(offsetof(LabelledPoint, intensity) == 12 && offsetof(LabelledPoint, label) == 13 &&
              offsetof(LabelledPoint, row) == 14);

/// Numbers of TurnWireHeader::sensor; they never change their meaning.
enum class StreamedSensor : std::uint8_t { kUnknown = 0, kHdl64e = 1, kRuby128 = 2 };

[[nodiscard]] constexpr StreamedSensor streamed_sensor(sensor::SensorModel model) noexcept {
  switch (model) {
    case sensor::SensorModel::kHdl64e:
      return StreamedSensor::kHdl64e;
    case sensor::SensorModel::kRuby128:
      return StreamedSensor::kRuby128;
    default:
      return StreamedSensor::kUnknown;
  }
}

/// Bits of TurnWireHeader::flags. Readers ignore bits they do not know.
inline constexpr std::uint32_t kTurnComplete = 1U << 0;  ///< Every firing was seen, seam to seam.
inline constexpr std::uint32_t kTurnLate = 1U << 1;      ///< Labelled after its deadline.
/// The vehicle's motion was taken out: points lie where they were at one instant of the turn.
inline constexpr std::uint32_t kTurnMotionTakenOut = 1U << 2;
/// It was to be taken out but is not known: points lie where the sensor saw them.
inline constexpr std::uint32_t kTurnNoEgoMotion = 1U << 3;

inline constexpr std::array<char, 4> kTurnMagic{'T', 'C', 'L', 'T'};
/// Grows only when readers of the version before could no longer read. New fields go to the end of
/// the header or of the point, and readers skip what header_bytes and point_bytes say is there.
inline constexpr std::uint16_t kTurnWireVersion = 1;
/// What a reader need not fear to be exceeded: six times a Ruby128's dual-return turn.
inline constexpr std::uint32_t kMostTurnPoints = 4'194'304;

struct TurnWireHeader {
  std::array<char, 4> magic = kTurnMagic;
  std::uint16_t version = kTurnWireVersion;
  std::uint16_t header_bytes = 56;
  std::uint32_t number = 0;  ///< Of the turn, 0.. since the sender's start; gaps are turns without.
  std::uint32_t points = 0;
  std::int64_t first_packet_ns = 0;  ///< CLOCK_REALTIME, kernel's stamps.
  std::int64_t last_packet_ns = 0;
  std::int64_t labels_ns = 0;  ///< CLOCK_REALTIME; when the labels were there. 0: not known.
  std::uint16_t point_bytes = sizeof(LabelledPoint);
  std::uint8_t sensor = 0;   ///< StreamedSensor.
  std::uint8_t rung = 0;     ///< status::Rung: 0 full, 1 cut stopped, 2 coarse, 3 skipped.
  std::uint32_t flags = 0;   ///< kTurnComplete, ...
  std::uint32_t missed = 0;  ///< Turns this reader was too slow for, since it connected.
  std::uint32_t reserved = 0;

  bool operator==(const TurnWireHeader&) const = default;
};
static_assert(sizeof(TurnWireHeader) == 56 && std::is_trivially_copyable_v<TurnWireHeader>);
static_assert(offsetof(TurnWireHeader, header_bytes) == 6 &&
              offsetof(TurnWireHeader, number) == 8 && offsetof(TurnWireHeader, points) == 12 &&
              offsetof(TurnWireHeader, first_packet_ns) == 16 &&
              offsetof(TurnWireHeader, last_packet_ns) == 24 &&
              offsetof(TurnWireHeader, labels_ns) == 32 &&
              offsetof(TurnWireHeader, point_bytes) == 40 &&
              offsetof(TurnWireHeader, sensor) == 42 && offsetof(TurnWireHeader, rung) == 43 &&
              offsetof(TurnWireHeader, flags) == 44 && offsetof(TurnWireHeader, missed) == 48);
static_assert(static_cast<int>(status::Rung::kFull) == 0 &&
                  static_cast<int>(status::Rung::kSkipped) == 3,
              "the wire's numbers are the enumeration's");

/// The first bytes of every header of any version: as much as tells how long it is.
inline constexpr std::size_t kTurnPreambleBytes = 8;

/// How many bytes the whole header has, from its first kTurnPreambleBytes. kMalformed: not a
/// labelled turn, or a header shorter than version 1's. kUnsupported: another version.
[[nodiscard]] Expected<std::size_t> turn_header_bytes(std::span<const std::byte> preamble);

/// A whole header, checked: `bytes` has at least turn_header_bytes() of itself. Errors as there,
/// and kMalformed for points shorter than version 1's, kCapacityExceeded for more than
/// kMostTurnPoints.
[[nodiscard]] Expected<TurnWireHeader> parse_turn_header(std::span<const std::byte> bytes);

}  // namespace terracut::stream
