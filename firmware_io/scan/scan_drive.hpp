// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "calib/hdl64e_calibration.hpp"
#include "firmware_io/drive/drive_writer.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_encoder.hpp"
#include "rt/error.hpp"

namespace terracut::firmware_io {

/// How `terracut encode` makes a drive of recorded scans.
struct ScanDriveOptions {
  /// The unit's table; without one it is fitted from the scans themselves.
  std::optional<calib::Hdl64eCalibration> calibration;
  bool undo_compensation = false;  ///< Put the sensor's motion back (needs poses.txt, times.txt).
  std::int64_t first_stamp_ns = 1'600'000'000'000'000'000;  ///< Capture time of the first firing.
  std::function<void(std::size_t done, std::size_t of)> on_scan;  ///< Progress; may be empty.
};

/// What came of it.
struct ScanDriveReport {
  DriveSummary drive;
  EncodeSummary encoded;
  std::optional<FittedRings> fitted;     ///< Where no calibration was given.
  calib::Hdl64eCalibration calibration;  ///< The one used.
};

/// Encodes all scans of a folder (scan_folder.hpp), one turn each, as "<name>.pcap" with
/// "<name>.calibration.xml" and "<name>.truth/" (drive_writer.hpp). Whole or not at all.
[[nodiscard]] Expected<ScanDriveReport> encode_scan_folder(const std::filesystem::path& folder,
                                                           const std::filesystem::path& pcap_path,
                                                           const ScanDriveOptions& options);

}  // namespace terracut::firmware_io
