// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "rt/error.hpp"
#include "scan_encoder.hpp"
#include "scan_resampler.hpp"
#include "tools/lab/drive/drive_writer.hpp"

namespace terracut::encode {

/// How `terracut encode` makes a drive of recorded scans.
struct ScanDriveOptions {
  /// The unit's table; without one it is fitted from the scans themselves.
  std::optional<hdl64e::Hdl64eCalibration> calibration;
  scan::PutMotionBack motion = scan::PutMotionBack::kWhereKnown;
  /// Write the motion put back as a CAN log beside the capture (motion/vehicle_log.hpp), too;
  /// kInvalidArgument where none is. A recorded frame begins behind, a frame of packets straight
  /// ahead, so the sensor is reversed: it looks backwards, and its vehicle drives backwards.
  /// Each frame then is one scan, as it was measured; brought to its middle it is the recorded one,
  /// rotated by 180 degrees.
  bool can_log = false;
  std::int64_t first_stamp_ns = 1'600'000'000'000'000'000;  ///< Capture time of the first firing.
  /// Progress; may be empty. An error ends the work and is passed on; nothing is written then.
  std::function<Status(std::size_t done, std::size_t of)> on_scan;
};

/// What came of it.
struct ScanDriveReport {
  drive::DriveSummary drive;
  EncodeSummary encoded;
  double spin_hz = 0;                       ///< Of the head, as the recording tells.
  std::string why_as_recorded;              ///< Empty where the motion was put back.
  std::optional<scan::FittedRings> fitted;  ///< Where no calibration was given.
  hdl64e::Hdl64eCalibration calibration;    ///< The one used.
};

/// Encodes all scans of a folder (scan_folder.hpp), one frame each, as "<name>.pcap" with
/// "<name>.calibration.xml" and "<name>.truth/" (drive_writer.hpp). Whole or not at all.
[[nodiscard]] Expected<ScanDriveReport> encode_scan_folder(const std::filesystem::path& folder,
                                                           const std::filesystem::path& pcap_path,
                                                           const ScanDriveOptions& options);

/// How scans become the drive of another sensor.
template <class EncoderTraits>
struct ResampleOptions {
  typename EncoderTraits::Calibration calibration = EncoderTraits::nominal();
  scan::PutMotionBack motion = scan::PutMotionBack::kWhereKnown;
  std::int64_t first_stamp_ns = 1'600'000'000'000'000'000;
  std::function<Status(std::size_t done, std::size_t of)> on_scan;  ///< As in ScanDriveOptions.
};

struct ResampleReport {
  drive::DriveSummary drive;
  ResampleSummary rays;
  std::string why_as_recorded;  ///< Empty where the motion was put back.
};

/// Writes what another sensor in the place of the recording HDL-64E might have sent of the scans of
/// a folder, one frame each: synthetic (scan_resampler.hpp). The device packets of an RS-Ruby128
/// say so by the serial number "RESAMP"; a Velodyne's packets have no place for it. Files and
/// errors as encode_scan_folder(); the sensors are ScanResampler's.
template <class EncoderTraits>
[[nodiscard]] Expected<ResampleReport> resample_scan_folder(
    const std::filesystem::path& folder, const std::filesystem::path& pcap_path,
    const std::type_identity_t<ResampleOptions<EncoderTraits>>& options);

}  // namespace terracut::encode
