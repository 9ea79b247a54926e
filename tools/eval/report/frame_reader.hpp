// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "calib/ring_profile.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "pipeline/range_image.hpp"
#include "rt/error.hpp"
#include "rt/fixed_memory.hpp"
#include "tools/eval/class_table.hpp"
#include "tools/eval/scan_way.hpp"

namespace terracut::evaluation::report {

/// Reads single frames of a dataset that was evaluated once more: for pictures, and to count over
/// cells what the evaluation does not keep. Straight into the range image, with the rings that the
/// evaluation used.
class FrameReader {
 public:
  /// `root` as in EvaluationConfig; `classes` must outlive this.
  FrameReader(std::filesystem::path root, const calib::Mount& mount, const ClassTable& classes)
      : root_(std::move(root)), mount_(mount), classes_(classes) {}

  /// `frame`: its name, "000009". After an error there is no frame. kNotFound: no such sequence,
  /// frame or label file; else as ScanReader.
  [[nodiscard]] Status read(const std::string& sequence, const std::string& frame);

  /// Of the last frame that was read; valid until the next.
  [[nodiscard]] const pipeline::RangeImage& image() const noexcept { return *placed_.image; }
  /// What its points are with all physical ground as ground, by return index of image().
  [[nodiscard]] std::span<const Role> truth() const noexcept { return truth_; }
  [[nodiscard]] std::span<const std::uint32_t> point_of_return() const noexcept {
    return placed_.point_of_return;
  }
  [[nodiscard]] const firmware_io::KittiScan& scan() const noexcept { return scan_; }
  [[nodiscard]] const firmware_io::RingRecovery& rings() const noexcept { return rings_; }
  [[nodiscard]] const std::string& sequence() const noexcept { return sequence_; }
  [[nodiscard]] const calib::Hdl64eCalibration& calibration() const noexcept {
    return calibration_;
  }
  [[nodiscard]] const calib::RingProfile& profile() const noexcept { return profile_; }

 private:
  [[nodiscard]] Status open(const std::string& sequence);

  std::filesystem::path root_;
  calib::Mount mount_;
  const ClassTable& classes_;

  std::string sequence_;  ///< That is open; empty: none.
  std::unique_ptr<firmware_io::ScanReader> reader_;
  std::map<std::string, std::size_t> scan_of_frame_;
  calib::Hdl64eCalibration calibration_;
  calib::RingProfile profile_;
  std::unique_ptr<rt::FixedMemory> memory_;
  std::unique_ptr<DirectWay> way_;

  firmware_io::KittiScan scan_;
  firmware_io::RingRecovery rings_;
  PlacedScan placed_;
  std::vector<Role> truth_;
};

}  // namespace terracut::evaluation::report
