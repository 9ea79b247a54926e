// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "calib/ring_profile.hpp"
#include "pipeline/range_image.hpp"
#include "rt/error.hpp"
#include "rt/fixed_memory.hpp"
#include "tools/eval/class_table.hpp"
#include "tools/eval/datasets/dataset.hpp"
#include "tools/eval/scan_way.hpp"

namespace terracut::evaluation::report {

/// Reads single frames of a dataset that was evaluated once more: for pictures, and to count over
/// cells what the evaluation does not keep. Straight into the range image, with the rings that the
/// evaluation used.
class FrameReader {
 public:
  /// `dataset` and `classes` must outlive this.
  FrameReader(const Dataset& dataset, const calib::Mount& mount, const ClassTable& classes)
      : dataset_(dataset), mount_(mount), classes_(classes) {}

  /// `frame`: its name, "000009". After an error there is no frame. kNotFound: no such sequence
  /// or frame; else as Sequence::read().
  [[nodiscard]] Status read(const std::string& sequence, const std::string& frame);

  /// Of the last frame that was read; valid until the next.
  [[nodiscard]] const pipeline::RangeImage& image() const noexcept { return *placed_.image; }
  /// What its points are with all physical ground as ground, by return index of image().
  [[nodiscard]] std::span<const Role> truth() const noexcept { return truth_; }
  /// 1 for what is ground with the road alone as ground, by return index.
  [[nodiscard]] std::span<const std::uint8_t> is_road() const noexcept { return is_road_; }
  [[nodiscard]] std::span<const std::uint32_t> point_of_return() const noexcept {
    return placed_.point_of_return;
  }
  [[nodiscard]] const firmware_io::KittiScan& scan() const noexcept { return labelled_.scan; }
  [[nodiscard]] const firmware_io::RingRecovery& rings() const noexcept { return labelled_.rings; }
  [[nodiscard]] const std::string& sequence() const noexcept { return sequence_; }
  [[nodiscard]] const calib::Hdl64eCalibration& calibration() const noexcept {
    return open_->calibration();
  }
  [[nodiscard]] const calib::RingProfile& profile() const noexcept { return profile_; }

 private:
  [[nodiscard]] Status open(const std::string& sequence);

  const Dataset& dataset_;
  calib::Mount mount_;
  const ClassTable& classes_;

  std::string sequence_;  ///< That is open; empty: none.
  std::unique_ptr<Sequence> open_;
  std::map<std::string, std::size_t> scan_of_frame_;
  calib::RingProfile profile_;
  std::unique_ptr<rt::FixedMemory> memory_;
  std::unique_ptr<DirectWay> way_;

  LabelledScan labelled_;
  PlacedScan placed_;
  std::vector<Role> truth_;
  std::vector<std::uint8_t> is_road_;
};

}  // namespace terracut::evaluation::report
