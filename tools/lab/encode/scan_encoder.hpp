// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "firing_schedule.hpp"
#include "firmware_io/frame/labelled_return.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "rt/error.hpp"

namespace terracut::encode {

/// Why a point of a scan is not among the encoded returns.
enum class NotEncoded : std::uint8_t {
  kNoPlace,      ///< is_place() is false: null, NaN, infinite or absurdly far.
  kUnknownRing,  ///< No laser could be told for it.
  kTooNear,      ///< Its distance is below what the calibration can say (raw count < 1).
  kTooFar,       ///< Its distance is beyond the wire's 65535 counts.
  kSeam,         ///< The beam that hits it belongs to the frame before or after.
  kCollision,    ///< Its laser has no firing left near enough: its neighbours took them.
  kCount,
};
inline constexpr std::size_t kNotEncodedReasons = static_cast<std::size_t>(NotEncoded::kCount);

/// Stable lower_snake_case name, as in reports.
[[nodiscard]] std::string_view to_string(NotEncoded reason) noexcept;

/// One encoded frame.
struct EncodedFrame {
  std::size_t points = 0;   ///< Of the scan.
  std::size_t encoded = 0;  ///< = returns of this frame's truth.
  std::size_t firings = 0;  ///< While the head was in this frame; 360 / firings is the mean step.
  double max_azimuth_error_deg = 0;  ///< Decoded against the scan's; at most 180 / firings + 0.01.
};

/// What became of the points.
struct EncodeSummary {
  std::vector<EncodedFrame> frames;
  std::size_t points = 0;  ///< = encoded + the sum of not_encoded.
  std::size_t encoded = 0;
  std::array<std::size_t, kNotEncodedReasons> not_encoded{};
  double max_range_error_m = 0;  ///< Of the range decoded from the wire against the scan's.
  scan::HeightResidual height;   ///< Decoded height against the scan's.
};

/// A firing and the points it came from.
struct EncodedFiring {
  frame::FiringColumn column;
  struct Source {
    std::int32_t frame = -1;  ///< Number of the add_frame() call, from 0; -1 without a return.
    std::uint32_t point = 0;  ///< Index in that scan.
  };
  std::array<Source, hdl64e::kHdl64eLasers> sources{};
};

/// Takes recorded scans back to what an HDL-64E with a given calibration would have sent: one scan
/// is one frame, consecutive scans are consecutive frames.
///
/// A point becomes a return of its ring's laser (rings by elevation). Its raw distance is the one
/// whose decoded range (from the sensor's origin) equals the point's, to the wire's 2 mm; its
/// firing is chosen (firing_schedule.hpp) so that the decoded azimuth is at most half the frame's
/// mean firing step + 0.01 degrees off. Only the height follows from the calibration alone; how far
/// off it is, is reported. Two points never share a firing of a laser.
///
/// Firings start 11 degrees before the first seam and end as far after the last one. The head's
/// azimuth of the first frame starts at 36000.  Allocates; one thread; deterministic.
class ScanEncoder {
 public:
  static constexpr std::int64_t kFiring_ns = 48'000;  ///< From firing to firing (single return).
  static constexpr std::int64_t kRunUp_cdeg = 1100;   ///< Before the first seam, after the last.

  /// Receives the firings in order; an error ends the encoding and is handed on.
  using Sink = std::function<Status(const EncodedFiring&)>;

  ScanEncoder(const hdl64e::Hdl64eCalibration& calibration, std::int64_t first_stamp_ns, Sink sink);

  /// Adds the next frame. `ring_of_point`: 0..63 or kNoRing for each point; `labels`: one for each
  /// point, or empty (truth 0).
  [[nodiscard]] Status add_frame(std::span<const scan::ScanPoint> points,
                                 std::span<const std::int16_t> ring_of_point,
                                 std::span<const std::uint32_t> labels);

  /// Sends all that is left. Nothing may be added afterwards.
  [[nodiscard]] Expected<EncodeSummary> finish();

 private:
  struct PendingPoint {
    double range_m, z_m, azimuth_rad;
    std::uint32_t label, index;
    std::uint8_t intensity;
  };

  [[nodiscard]] bool want(std::int32_t frame, int laser, const scan::ScanPoint& point,
                          PendingPoint& pending, WantedBeam& beam);
  void schedule_frame();
  [[nodiscard]] Status send_before(std::int64_t azimuth_cdeg);
  [[nodiscard]] Status send_packet();
  void encode(const WantedBeam& beam, int laser, std::int64_t column_cdeg, std::int32_t step_ticks,
              EncodedFiring& firing);
  void count(NotEncoded reason) { ++summary_.not_encoded[static_cast<std::size_t>(reason)]; }
  void add_height_error(double error_m);

  hdl64e::Hdl64eCalibration calibration_;
  hdl64e::Hdl64eGeometry geometry_;
  std::array<int, scan::kScanRings> laser_of_ring_;
  hdl64e::BeamOffsets offsets_;
  FiringSchedule schedule_;
  FiringSchedule::Packet packet_;
  Sink sink_;
  std::int64_t stamp_ns_;
  std::array<std::vector<WantedBeam>, hdl64e::kHdl64eLasers> wanted_;
  std::array<std::vector<PendingPoint>, 2>
      pending_;  ///< Of this frame and the one before, by parity.
  EncodeSummary summary_;
  std::vector<std::uint64_t> height_errors_;  ///< Histogram, millimetres.
  double height_squares_ = 0;
};

}  // namespace terracut::encode
