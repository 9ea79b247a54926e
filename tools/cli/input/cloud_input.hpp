// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The clouds of a folder, or one alone, read one by one.
class CloudReader {
 public:
  /// The errors of scan::list_scan_folder().
  [[nodiscard]] static Expected<CloudReader> open(const std::filesystem::path& clouds);

  [[nodiscard]] std::size_t size() const { return files_.size(); }
  [[nodiscard]] const scan::ScanFile& file(std::size_t index) const { return files_[index]; }

  /// Valid until the next one is read.
  [[nodiscard]] Expected<cloud::CloudView> read(std::size_t index);
  /// The truth of a cloud of so many points; left empty where there is none.
  [[nodiscard]] Status read_labels(std::size_t index, std::size_t points,
                                   std::vector<std::uint32_t>& labels) const;

 private:
  explicit CloudReader(std::vector<scan::ScanFile> files) : files_(std::move(files)) {}

  std::vector<scan::ScanFile> files_;
  cloud::Cloud cloud_;
};

/// Clouds and captures go by what the files are named: a folder, or a file of a cloud's name.
[[nodiscard]] bool holds_clouds(const std::filesystem::path& input);

/// How the clouds tell their lasers, and the lasers' elevations: of `calibration`, whose unit's
/// scans are in KITTI's order, or where that is empty learnt from the clouds, which is said.
[[nodiscard]] Expected<cloud::SensorRows> rows_of(CloudReader& clouds,
                                                  const std::filesystem::path& calibration);

}  // namespace terracut::cli
