// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"
#include "tools/lab/encode/sensor_motion.hpp"

namespace terracut::encode {

/// Whether to restore the sensor's motion, for which recorded scans are compensated
/// (motion_compensation.hpp). This needs poses.txt and times.txt beside velodyne/, with poses of
/// all scans, and scans named by their frame number.
enum class PutMotionBack {
  kNever,
  kWhereKnown,  ///< If these files are present.
};

/// Reads the scans of a folder one by one, with the ring of every point.
class ScanReader {
 public:
  /// Lists the folder (scan_folder.hpp). Fails with the errors of the listing and, if motion is
  /// restored, with those of SensorMotion::read().
  [[nodiscard]] static Expected<ScanReader> open(const std::filesystem::path& folder,
                                                 PutMotionBack motion = PutMotionBack::kNever);

  /// Returns why motion is not restored; empty if it is.
  [[nodiscard]] const std::string& why_as_recorded() const noexcept { return why_as_recorded_; }

  [[nodiscard]] std::size_t size() const noexcept { return folder_.scans.size(); }
  [[nodiscard]] const scan::ScanFile& file(std::size_t index) const { return folder_.scans[index]; }

  /// Reads scan `index` into `scan`, with labels if it has them, and the rings of its points. A
  /// scan without exactly 64 rings needs a table: call fit_rings() or use_rings() first.
  [[nodiscard]] Status read(std::size_t index, scan::KittiScan& scan,
                            scan::RingRecovery& rings) const;

  /// Returns the motion restored in scan `index`; nothing if none was.
  [[nodiscard]] Expected<std::optional<SensorTwist>> twist(std::size_t index) const;

  /// Fits the unit's ring table (ring_fit_of_scans.hpp) and uses it from then on.
  [[nodiscard]] Expected<scan::FittedRings> fit_rings();
  void use_rings(const scan::RingTable& table) { table_ = table; }

 private:
  [[nodiscard]] Status read(std::size_t index, const scan::RingTable* table, scan::KittiScan& scan,
                            scan::RingRecovery& rings) const;

  scan::ScanFolder folder_;
  std::optional<SensorMotion> motion_;  ///< The motion to put back; empty: none.
  std::string why_as_recorded_;
  std::optional<scan::RingTable> table_;
};

}  // namespace terracut::encode
