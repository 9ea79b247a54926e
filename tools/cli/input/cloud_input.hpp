// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bag_clouds.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Reads the clouds of a folder, of a bag, or a single cloud, one by one.
class CloudReader {
 public:
  /// Opens a folder, a file, or the topic of a bag. Fails with the errors of
  /// scan::list_scan_folder() or BagClouds::open().
  [[nodiscard]] static Expected<CloudReader> open(const std::filesystem::path& clouds,
                                                  std::string_view topic);

  /// Returns the path given to open().
  [[nodiscard]] const std::filesystem::path& input() const { return input_; }
  [[nodiscard]] std::size_t size() const { return bag_ ? bag_->size() : files_.size(); }
  /// Returns a cloud's file, or which cloud of which bag it is, for messages.
  [[nodiscard]] std::string place(std::size_t index) const;
  /// Returns the name of the files made of a cloud: "000009".
  [[nodiscard]] std::string name(std::size_t index) const;
  /// Returns the number in a cloud's name; of a bag or without one, `index`.
  [[nodiscard]] std::uint32_t number(std::size_t index) const;
  /// Returns the stamp of the cloud read last, nanoseconds since 1970; nothing for files, which
  /// have none.
  [[nodiscard]] std::optional<std::int64_t> stamp_ns() const;
  /// Fills the figures of the mount that were not stated by what a bag says of it.
  [[nodiscard]] MountOptions stated(const MountOptions& mount) const;

  /// Sets the sensor's position among the points of the clouds read from now on.
  void take_sensor_at(cloud::SensorPlace place);
  /// Sets the transform from the sensor frame to the frame of the points.
  void take_sensor_at(const mount::RigidTransform& T_points_sensor);
  /// True if a file read so far states a VIEWPOINT.
  [[nodiscard]] bool has_viewpoint() const { return has_viewpoint_; }

  /// Reads one cloud, valid until the next cloud is read.
  [[nodiscard]] Expected<cloud::CloudView> read(std::size_t index);
  /// True if a cloud has its truth beside it, as SemanticKITTI's have.
  [[nodiscard]] bool has_labels() const;
  /// Reads the truth of a cloud of `points` points into `labels`, empty if there is no truth.
  [[nodiscard]] Status read_labels(std::size_t index, std::size_t points,
                                   std::vector<std::uint32_t>& labels) const;

 private:
  CloudReader(std::filesystem::path input, std::vector<scan::ScanFile> files,
              std::optional<BagClouds> bag)
      : input_(std::move(input)), files_(std::move(files)), bag_(std::move(bag)) {}

  std::filesystem::path input_;
  std::vector<scan::ScanFile> files_;
  std::optional<BagClouds> bag_;  ///< In place of files.
  cloud::Cloud cloud_;
  cloud::SensorPlace place_ = cloud::SensorPlace::kOrigin;
  std::optional<mount::RigidTransform> to_sensor_;
  bool has_viewpoint_ = false;
};

/// Tells clouds from captures: true for a folder or a file with a cloud's name, and for a bag of
/// which --topic, or its only topic of packets or clouds, holds clouds. Fails as bag::Bag::open()
/// and bag::choose_topic() do.
[[nodiscard]] Expected<bool> holds_clouds(const CaptureOptions& options);

/// Returns how the clouds tell their lasers apart, and the lasers' elevations. With a
/// `calibration`, both are that unit's, and the scans must be in KITTI's order; otherwise they are
/// learnt from the clouds. Prints the result, with a warning if it is doubtful (cloud::doubt_of()).
/// If the points fit only, or better, with the files' VIEWPOINT as the sensor's position, or with
/// one that the cones of the lasers show (cloud::find_sensor_pose()), that position is used from
/// then on. Errors name the file or the folder.
[[nodiscard]] Expected<cloud::SensorRows> rows_of(CloudReader& clouds,
                                                  const std::filesystem::path& calibration);

}  // namespace terracut::cli
