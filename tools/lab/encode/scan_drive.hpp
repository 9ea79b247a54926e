// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "rt/error.hpp"
#include "scan_encoder.hpp"
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

}  // namespace terracut::encode
