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
#include "firmware_io/scan/sensor_motion.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// Whether the sensor's motion, which recorded scans are compensated for, is put back into them
/// (motion_compensation.hpp). It takes poses.txt and times.txt beside velodyne/, with poses of all
/// scans, and scans named by their frame number.
enum class PutMotionBack {
  kNever,
  kWhereKnown,  ///< Where that is there.
  kAlways,      ///< An error where it is not.
};

/// Reads the scans of a folder one by one, with the ring of every point.
class ScanReader {
 public:
  /// Lists the folder (scan_folder.hpp). Errors: its own; those of SensorMotion::read() where the
  /// motion is to be put back; with kAlways kNotFound where what that takes is not there.
  [[nodiscard]] static Expected<ScanReader> open(const std::filesystem::path& folder,
                                                 PutMotionBack motion = PutMotionBack::kNever);

  /// Why the scans are read as they are recorded; empty where their motion is put back.
  [[nodiscard]] const std::string& why_as_recorded() const noexcept { return why_as_recorded_; }

  [[nodiscard]] std::size_t size() const noexcept { return folder_.scans.size(); }
  [[nodiscard]] const ScanFile& file(std::size_t index) const { return folder_.scans[index]; }

  /// Reads scan `index` into `scan`, labels included where it has them, and the rings of its
  /// points. Scans with other than 64 rings need a table: fit_rings() or use_rings() first.
  [[nodiscard]] Status read(std::size_t index, KittiScan& scan, RingRecovery& rings) const;

  /// The motion that was put back into scan `index`; nothing where none was.
  [[nodiscard]] Expected<std::optional<SensorTwist>> twist(std::size_t index) const;

  /// Fits the unit's ring table (ring_fit_of_scans.hpp) and uses it from then on.
  [[nodiscard]] Expected<FittedRings> fit_rings();
  void use_rings(const RingTable& table) { table_ = table; }

 private:
  [[nodiscard]] Status read(std::size_t index, const RingTable* table, KittiScan& scan,
                            RingRecovery& rings) const;

  ScanFolder folder_;
  std::optional<SensorMotion> motion_;  ///< Only where it is to be put back.
  std::string why_as_recorded_;
  std::optional<RingTable> table_;
};

}  // namespace terracut::scan
