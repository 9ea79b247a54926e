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
#include "rt/error.hpp"
#include "scan_encoder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/encode/scan_reader.hpp"

namespace terracut::encode {

/// The options of `terracut encode` for a drive made of recorded scans.
struct ScanDriveOptions {
  /// The unit's table; without one it is fitted from the scans.
  std::optional<hdl64e::Hdl64eCalibration> calibration;
  PutMotionBack motion = PutMotionBack::kWhereKnown;
  /// True: also writes the restored motion as a CAN log beside the capture (drive/vehicle_log.hpp);
  /// fails with kInvalidArgument if none was restored. A recorded frame begins behind the sensor,
  /// but a frame of packets straight ahead. So the sensor is reversed: it looks backwards, and its
  /// vehicle drives backwards. Each frame is then one scan as it was measured; deskewed to its
  /// middle, it is the recorded scan, rotated by 180 degrees.
  bool can_log = false;
  std::int64_t first_stamp_ns = 1'600'000'000'000'000'000;  ///< Capture time of the first firing.
  /// Reports progress; may be empty. If it returns an error, the work ends, that error is returned,
  /// and nothing is written.
  std::function<Status(std::size_t done, std::size_t of)> on_scan;
};

/// The result of encoding.
struct ScanDriveReport {
  drive::DriveSummary drive;
  EncodeSummary encoded;
  double spin_hz = 0;                       ///< Spin rate of the head, estimated.
  std::string why_as_recorded;              ///< Why motion was not restored; empty if it was.
  std::optional<scan::FittedRings> fitted;  ///< Set if no calibration was given.
  hdl64e::Hdl64eCalibration calibration;    ///< The calibration used.
};

/// Encodes all scans of a folder (scan_folder.hpp), one frame each, as "<name>.pcap" with
/// "<name>.calibration.xml" and "<name>.truth/" (drive_writer.hpp), whole or not at all.
[[nodiscard]] Expected<ScanDriveReport> encode_scan_folder(const std::filesystem::path& folder,
                                                           const std::filesystem::path& pcap_path,
                                                           const ScanDriveOptions& options);

}  // namespace terracut::encode
