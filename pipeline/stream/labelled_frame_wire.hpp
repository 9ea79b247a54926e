// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "calib/sensor/sensor_model.hpp"
#include "pipeline/output/label_sink.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "pipeline/points/sector_record.hpp"
#include "pipeline/status/frame_record.hpp"

/// The wire format of labelled frames on a socket (docs/reference/labelled_stream.md): a header,
/// the points, then the next frame's header. Little-endian, without padding, used in place.
namespace terracut::stream {

static_assert(std::endian::native == std::endian::little, "the records below are sent as they lie");

/// One return on the wire. `label` is a SemanticKITTI class as in .label files (label_sink.hpp);
/// the other fields are as in points::LabelledPoint.
struct WirePoint {
  float x_m = 0, y_m = 0, z_m = 0;
  std::uint8_t intensity = 0;
  std::uint8_t label = 0;
  std::uint16_t row = 0;
  float time_s = 0;

  bool operator==(const WirePoint&) const = default;
};
static_assert(sizeof(WirePoint) == 20 && std::is_trivially_copyable_v<WirePoint>);
static_assert(offsetof(WirePoint, intensity) == 12 && offsetof(WirePoint, label) == 13 &&
              offsetof(WirePoint, row) == 14 && offsetof(WirePoint, time_s) == 16);

[[nodiscard]] constexpr WirePoint wire_point(const points::LabelledPoint& point) noexcept {
  return {point.x_m,
          point.y_m,
          point.z_m,
          point.intensity,
          static_cast<std::uint8_t>(output::semantic_kitti_class(point.label)),
          point.row,
          point.time_s};
}

/// How many bytes a point has if it comes with its height above the ground: WirePoint, then a
/// float.
inline constexpr std::uint16_t kPointBytesWithHeight = sizeof(WirePoint) + sizeof(float);
/// How many bytes it has if it comes with its height and the number of its object (0: none), a
/// uint32.
inline constexpr std::uint16_t kPointBytesWithObject =
    kPointBytesWithHeight + sizeof(std::uint32_t);

/// Writes points as they are sent, each with its height if a point has room for one, NaN where
/// there is no height, and with the number of its object if there is room for that, too.
inline void write_points(std::span<const points::LabelledPoint> points,
                         std::span<const float> heights_m, std::span<const std::uint16_t> objects,
                         std::size_t point_bytes, std::span<std::byte> room) noexcept {
  std::byte* to = room.data();
  for (std::size_t i = 0; i < points.size(); ++i, to += point_bytes) {
    const WirePoint point = wire_point(points[i]);
    std::memcpy(to, &point, sizeof point);
    if (point_bytes == sizeof point) continue;
    const float height_m =
        i < heights_m.size() ? heights_m[i] : std::numeric_limits<float>::quiet_NaN();
    std::memcpy(to + sizeof point, &height_m, sizeof height_m);
    if (point_bytes == kPointBytesWithHeight) continue;
    const std::uint32_t object = i < objects.size() ? objects[i] : 0;
    std::memcpy(to + kPointBytesWithHeight, &object, sizeof object);
  }
}

/// Bits of FrameWireHeader::flags. Readers ignore bits they do not know.
inline constexpr std::uint32_t kFrameComplete = 1U << 0;  ///< Every firing was seen, seam to seam.
inline constexpr std::uint32_t kFrameLate = 1U << 1;      ///< Labelled after its deadline.
/// Deskewed: each point lies where it was at one common instant of the frame.
inline constexpr std::uint32_t kFrameDeskewed = 1U << 2;
/// Deskewing was asked for but not done for lack of motion: points lie where they were seen.
inline constexpr std::uint32_t kFrameNoEgoMotion = 1U << 3;
/// A sector: a piece of the frame of this number, as labelled while the rest was still coming.
inline constexpr std::uint32_t kFrameSector = 1U << 4;

inline constexpr std::array<char, 4> kFrameMagic{'T', 'C', 'L', 'T'};
/// What a reader sends first to get sectors in place of frames.
inline constexpr std::array<char, 4> kSectorsPlease{'T', 'C', 'L', 'S'};
/// The version increases only if readers of the last version could no longer read. New fields are
/// added at the end of the header or point; readers skip them by header_bytes and point_bytes.
inline constexpr std::uint16_t kFrameWireVersion = 1;
/// The most points of a frame: six times a Ruby128's dual-return frame.
inline constexpr std::uint32_t kMostFramePoints = 4'194'304;

struct FrameWireHeader {
  std::array<char, 4> magic = kFrameMagic;
  std::uint16_t version = kFrameWireVersion;
  std::uint16_t header_bytes = 56;
  std::uint32_t number = 0;  ///< Frame number; a gap means frames without points.
  std::uint32_t points = 0;
  std::int64_t first_packet_ns = 0;  ///< Kernel's stamp, CLOCK_REALTIME.
  std::int64_t last_packet_ns = 0;
  std::int64_t labels_ns = 0;  ///< CLOCK_REALTIME when the labels were ready. 0: unknown.
  std::uint16_t point_bytes = sizeof(WirePoint);
  std::uint8_t sensor = 0;   ///< A value of StreamedSensor.
  std::uint8_t level = 0;    ///< status::Level: 0 full, 1 cut stopped, 2 coarse, 3 skipped.
  std::uint32_t flags = 0;   ///< Bits such as kFrameComplete.
  std::uint32_t missed = 0;  ///< Frames, or sectors, that this reader missed since it connected.
  std::uint32_t first_return = 0;  ///< Place in the frame of the first point that follows.

  bool operator==(const FrameWireHeader&) const = default;
};
static_assert(sizeof(FrameWireHeader) == 56 && std::is_trivially_copyable_v<FrameWireHeader>);
static_assert(offsetof(FrameWireHeader, header_bytes) == 6 &&
              offsetof(FrameWireHeader, number) == 8 && offsetof(FrameWireHeader, points) == 12 &&
              offsetof(FrameWireHeader, first_packet_ns) == 16 &&
              offsetof(FrameWireHeader, last_packet_ns) == 24 &&
              offsetof(FrameWireHeader, labels_ns) == 32 &&
              offsetof(FrameWireHeader, point_bytes) == 40 &&
              offsetof(FrameWireHeader, sensor) == 42 && offsetof(FrameWireHeader, level) == 43 &&
              offsetof(FrameWireHeader, flags) == 44 && offsetof(FrameWireHeader, missed) == 48 &&
              offsetof(FrameWireHeader, first_return) == 52);
/// Returns the header of a frame, with `missed` at 0.
[[nodiscard]] constexpr FrameWireHeader header_of(const status::FrameRecord& record,
                                                  sensor::SensorModel sensor, bool late,
                                                  std::size_t points) noexcept {
  const frame::DeskewState deskew = record.info.deskew.state;
  return {.number = record.info.number,
          .points = static_cast<std::uint32_t>(points),
          .first_packet_ns = record.info.first_packet_ns,
          .last_packet_ns = record.info.last_packet_ns,
          .labels_ns = record.labels_ns,
          .sensor = sensor::row_of(sensor).stream_number,
          .level = static_cast<std::uint8_t>(record.level),
          .flags = (record.info.complete ? kFrameComplete : 0U) | (late ? kFrameLate : 0U) |
                   (deskew == frame::DeskewState::kDone ? kFrameDeskewed : 0U) |
                   (deskew == frame::DeskewState::kNoEgoMotion ? kFrameNoEgoMotion : 0U)};
}
/// Returns the header that a reader by sectors gets after the last sector of a frame.
[[nodiscard]] constexpr FrameWireHeader without_points(FrameWireHeader header) noexcept {
  header.first_return = header.points;
  header.points = 0;
  return header;
}
/// Returns the header of a sector, with `missed` at 0. What is known of whole frames alone is 0.
[[nodiscard]] constexpr FrameWireHeader header_of(const points::SectorRecord& record,
                                                  sensor::SensorModel sensor, bool late,
                                                  std::size_t points) noexcept {
  return {.number = record.frame,
          .points = static_cast<std::uint32_t>(points),
          .first_packet_ns = record.first_packet_ns,
          .last_packet_ns = record.last_packet_ns,
          .labels_ns = record.labels_ns,
          .sensor = sensor::row_of(sensor).stream_number,
          .flags = kFrameSector | (late ? kFrameLate : 0U),
          .first_return = record.first_return};
}
static_assert(static_cast<int>(status::Level::kFull) == 0 &&
                  static_cast<int>(status::Level::kSkipped) == 3,
              "the wire's numbers are the enumeration's");

}  // namespace terracut::stream
