// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/datasets/dataset.hpp"
#include "tools/research/eval/scan_way.hpp"

namespace terracut::report {

/// Reads single frames of an evaluated dataset again, for pictures. Places them directly in the
/// range image, with the same rings as in the evaluation.
class FrameReader {
 public:
  /// `dataset` and `classes` must outlive this object.
  FrameReader(const datasets::Dataset& dataset, const mount::Mount& mount,
              const datasets::ClassTable& classes)
      : dataset_(dataset), mount_(mount), classes_(classes) {}

  /// Reads the frame with that name, such as "000009". After an error there is no frame. Fails with
  /// kNotFound if there is no such sequence or frame, otherwise as Sequence::read() does.
  [[nodiscard]] Status read(const std::string& sequence, const std::string& frame);

  /// Returns the image of the frame read last; valid until the next is read.
  [[nodiscard]] const frame::RangeImage& image() const noexcept { return *placed_.image; }
  /// Returns the role of each return, by return index of image(). All physical ground counts as
  /// ground.
  [[nodiscard]] std::span<const datasets::Role> truth() const noexcept { return truth_; }
  /// Returns 1 for each return whose class is road, else 0, by return index.
  [[nodiscard]] std::span<const std::uint8_t> is_road() const noexcept { return is_road_; }
  [[nodiscard]] std::span<const std::uint32_t> point_of_return() const noexcept {
    return placed_.point_of_return;
  }
  [[nodiscard]] const scan::KittiScan& scan() const noexcept { return labelled_.scan; }
  [[nodiscard]] const scan::RingRecovery& rings() const noexcept { return labelled_.rings; }
  [[nodiscard]] const std::string& sequence() const noexcept { return sequence_; }
  [[nodiscard]] const datasets::Sequence& scans() const noexcept { return *open_; }
  [[nodiscard]] const mount::RingProfile& profile() const noexcept { return profile_; }

 private:
  [[nodiscard]] Status open(const std::string& sequence);

  const datasets::Dataset& dataset_;
  mount::Mount mount_;
  const datasets::ClassTable& classes_;

  std::string sequence_;  ///< The open sequence; empty: none.
  std::optional<datasets::Sequence> open_;
  std::map<std::string, std::size_t> scan_of_frame_;
  mount::RingProfile profile_;
  std::unique_ptr<memory::FixedMemory> memory_;
  std::unique_ptr<eval::DirectWay> way_;

  datasets::LabelledScan labelled_;
  eval::PlacedScan placed_;
  std::vector<datasets::Role> truth_;
  std::vector<std::uint8_t> is_road_;
};

}  // namespace terracut::report
