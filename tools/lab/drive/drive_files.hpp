// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "rt/error.hpp"

namespace terracut::drive {

/// truth_folder_of() and calibration_path_of() return the paths of a drive's parts beside
/// "<folder>/<name>.pcap".
[[nodiscard]] std::filesystem::path truth_folder_of(const std::filesystem::path& pcap_path);
/// Returns an empty path for a sensor with a built-in table.
template <class EncoderTraits>
[[nodiscard]] std::filesystem::path calibration_path_of(const std::filesystem::path& pcap_path) {
  if (EncoderTraits::kCalibrationSuffix.empty()) return {};
  std::filesystem::path name = pcap_path.stem();
  name += EncoderTraits::kCalibrationSuffix;
  return pcap_path.parent_path() / name;
}

/// The truth and the table of an unfinished drive. They lie in a folder beside their final paths,
/// on the same file system, until put_in_place(); without that call nothing is left. One thread.
class DriveFiles {
 public:
  /// Fails with kInvalidArgument if an existing truth folder holds anything but NNNNNN.label files,
  /// because a folder is replaced only if it surely belongs to a drive; kWriteFailed if no folder
  /// can be made.
  [[nodiscard]] static Expected<DriveFiles> create(const std::filesystem::path& pcap_path);

  DriveFiles(DriveFiles&&) noexcept;
  DriveFiles& operator=(DriveFiles&&) noexcept;
  ~DriveFiles();

  /// Returns the path at which the table is to be written.
  [[nodiscard]] std::filesystem::path staged_calibration() const;
  /// Writes the truth of a frame as NNNNNN.label, little-endian. Fails with kWriteFailed.
  [[nodiscard]] Status write_truth(std::uint64_t frame, std::span<const std::uint32_t> labels);

  /// Checks the truth folder as create() does, because it may have changed since.
  [[nodiscard]] Status check_replaceable() const;
  /// `calibration_path` is empty if there is no table.
  [[nodiscard]] Status put_in_place(const std::filesystem::path& calibration_path);

 private:
  class Staging;
  DriveFiles(std::filesystem::path truth, std::unique_ptr<Staging> staging) noexcept;

  std::filesystem::path truth_;
  std::unique_ptr<Staging> staging_;
};

}  // namespace terracut::drive
