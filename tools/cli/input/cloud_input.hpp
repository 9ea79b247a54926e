// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The clouds of a folder, or one alone, read one by one.
class CloudReader {
 public:
  /// The errors of scan::list_scan_folder().
  [[nodiscard]] static Expected<CloudReader> open(const std::filesystem::path& clouds);

  /// As it was named to open().
  [[nodiscard]] const std::filesystem::path& input() const { return input_; }
  [[nodiscard]] std::size_t size() const { return files_.size(); }
  [[nodiscard]] const scan::ScanFile& file(std::size_t index) const { return files_[index]; }

  /// Where the sensor stood among the points of what is read from now on.
  void take_sensor_at(cloud::SensorPlace place) { place_ = place; }
  /// Whether a file that was read says where that is.
  [[nodiscard]] bool has_viewpoint() const { return has_viewpoint_; }

  /// Valid until the next one is read.
  [[nodiscard]] Expected<cloud::CloudView> read(std::size_t index);
  /// The truth of a cloud of so many points; left empty where there is none.
  [[nodiscard]] Status read_labels(std::size_t index, std::size_t points,
                                   std::vector<std::uint32_t>& labels) const;

 private:
  CloudReader(std::filesystem::path input, std::vector<scan::ScanFile> files)
      : input_(std::move(input)), files_(std::move(files)) {}

  std::filesystem::path input_;
  std::vector<scan::ScanFile> files_;
  cloud::Cloud cloud_;
  cloud::SensorPlace place_ = cloud::SensorPlace::kOrigin;
  bool has_viewpoint_ = false;
};

/// Clouds and captures go by what the files are named: a folder, or a file of a cloud's name.
[[nodiscard]] bool holds_clouds(const std::filesystem::path& input);

/// How the clouds tell their lasers, and the lasers' elevations: of `calibration`, whose unit's
/// scans are in KITTI's order, or where that is empty learnt from the clouds, which is said, with a
/// warning where it is doubtful (cloud::doubt_of()). Where nothing fits the points as they are, or
/// with doubt, but without where the files' VIEWPOINT is the sensor's place, that is taken from
/// then on. Errors name the file, or the folder.
[[nodiscard]] Expected<cloud::SensorRows> rows_of(CloudReader& clouds,
                                                  const std::filesystem::path& calibration);

}  // namespace terracut::cli
