// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "rt/error.hpp"
#include "tools/lab/drive/firing_plan.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/quality/error_counts.hpp"

namespace terracut::encode {

/// Why a point of a scan is not among the encoded returns.
enum class NotEncoded : std::uint8_t {
  kNoPlace,      ///< is_place() is false: null, NaN, infinite or absurdly far.
  kUnknownRing,  ///< Its laser could not be determined.
  kTooNear,      ///< Its distance is below the calibration's range (raw count < 1).
  kTooFar,       ///< Its distance is beyond the wire's 65535 counts.
  kSeam,         ///< The beam that hits it belongs to the previous or next frame.
  kCollision,    ///< All firings of its laser near enough are taken by other points.
  kCount,
};
inline constexpr std::size_t kNotEncodedReasons = static_cast<std::size_t>(NotEncoded::kCount);

/// Returns a stable lower_snake_case name for reports.
[[nodiscard]] std::string_view to_string(NotEncoded reason) noexcept;

/// One encoded frame.
struct EncodedFrame {
  std::size_t points = 0;            ///< Points of the scan.
  std::size_t encoded = 0;           ///< Number of returns in the frame's truth.
  double max_azimuth_shift_deg = 0;  ///< Azimuth as decoded minus the scan's.
};

/// Counts and errors of the encoded points.
struct EncodeSummary {
  std::vector<EncodedFrame> frames;
  std::size_t points = 0;  ///< The sum of encoded and not_encoded.
  std::size_t encoded = 0;
  std::array<std::size_t, kNotEncodedReasons> not_encoded{};
  double median_azimuth_shift_deg = 0, max_azimuth_shift_deg = 0;  ///< As decoded minus the scan's.
  double max_range_error_m = 0;  ///< Range as decoded minus the scan's.
  scan::HeightResidual height;   ///< Height as decoded minus the scan's.
};

/// A firing and the points it came from.
struct EncodedFiring {
  packets::FiringColumn column;
  struct Source {
    std::int32_t frame = -1;  ///< Index of its add_frame() call; -1 without a return.
    std::uint32_t point = 0;  ///< Index in that scan.
  };
  std::array<Source, hdl64e::kHdl64eLasers> sources{};
};

/// Encodes recorded scans as the packets of an HDL-64E with a given calibration: one scan is one
/// frame, consecutive scans are consecutive frames.
///
/// The head rotates steadily and all lasers fire every 48 us (drive/firing_plan.hpp). The
/// recording's head did so too, at `spin_hz` (recorded_spin.hpp), so nearly every point has a
/// firing of its own. A point becomes a return of its ring's laser (rings by elevation) at one
/// firing, moved by at most kFarthest_steps steps from firing to firing (firing_assignment.hpp);
/// points without a firing are counted. Its raw distance is the one whose decoded range (from the
/// sensor's origin) equals the point's, to the wire's 2 mm. The height follows from the calibration
/// alone; its error is reported.
///
/// Firings start 11 degrees before the first seam and end as far after the last one. The head's
/// azimuth in the first frame starts at 36000. Allocates; one thread; deterministic.
class ScanEncoder {
 public:
  static constexpr double kFarthest_steps = 4;

  struct Config {
    std::int64_t frames = 1;          ///< Number of future add_frame() calls.
    double spin_hz = 10;              ///< [5, 20].
    std::int64_t first_stamp_ns = 0;  ///< Stamp of the first firing.
  };

  /// Receives the firings in order; all together fill whole packets of six. An error ends the
  /// encoding and is returned.
  using Sink = std::function<Status(const EncodedFiring&)>;

  ScanEncoder(const hdl64e::Hdl64eCalibration& calibration, const Config& config, Sink sink);

  /// Adds the next frame. `ring_of_point` has a ring, 0..63 or kNoRing, for each point; `labels`
  /// has one for each point, or is empty (truth 0).
  [[nodiscard]] Status add_frame(std::span<const scan::ScanPoint> points,
                                 std::span<const std::int16_t> ring_of_point,
                                 std::span<const std::uint32_t> labels);

  /// Sends all remaining firings. Nothing may be added afterwards.
  [[nodiscard]] Expected<EncodeSummary> finish();

 private:
  struct Wanted {
    std::int64_t ticks = 0;  ///< Azimuth of the beam in its frame.
    double range_m = 0, z_m = 0, azimuth_rad = 0;
    std::uint32_t label = 0, point = 0;
    std::uint8_t intensity = 0;
  };
  struct Planned {
    drive::Firing when;
    EncodedFiring what;
  };

  [[nodiscard]] bool want(int laser, const scan::ScanPoint& point, Wanted& wanted);
  [[nodiscard]] Planned& planned(std::int64_t firing);
  void assign(std::int32_t frame, int laser);
  void encode(std::int32_t frame, int laser, const Wanted& wanted, Planned& planned);
  [[nodiscard]] Status send_before(std::int64_t firing);
  void count(NotEncoded reason) { ++summary_.not_encoded[static_cast<std::size_t>(reason)]; }

  hdl64e::Hdl64eCalibration calibration_;
  hdl64e::Hdl64eGeometry geometry_;
  std::array<int, scan::kScanRings> laser_of_ring_;
  hdl64e::BeamOffsets offsets_;
  drive::FiringPlan<packets::Hdl64eEncoderTraits> plan_;
  std::int64_t first_stamp_ns_, farthest_ticks_;
  Sink sink_;
  std::deque<Planned> planned_;  ///< Prepared firings that are not sent yet.
  std::int64_t sent_ = 0;        ///< Number of firings sent.
  /// First firing after the added frames, for each laser.
  std::array<std::int64_t, hdl64e::kHdl64eLasers> next_firing_{};
  std::array<std::vector<Wanted>, hdl64e::kHdl64eLasers> wanted_;
  EncodeSummary summary_;
  quality::ErrorCounts azimuth_shifts_deg_{0.001, 1000}, height_errors_m_{0.001, 5000};
};

}  // namespace terracut::encode
