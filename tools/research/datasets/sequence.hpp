// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cloud_layout.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "rt/error.hpp"
#include "tools/lab/encode/recorded_spin.hpp"
#include "tools/research/datasets/labelled_scan.hpp"

namespace terracut::datasets {

/// The frames of one sensor, in order of names.
class Sequence {
 public:
  /// Lists the frames in `folder` and learns the rings of their sensor. Errors name file or folder.
  /// Fails with kNotFound if there are no frames, with the error of reading if no frame can be
  /// read, and with kMalformed if the points of a laser do not lie on its cone around the origin,
  /// as in a map's frame.
  [[nodiscard]] static Expected<Sequence> open(const CloudLayout& layout,
                                               std::filesystem::path folder);

  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  /// Returns "000042", the name of a frame's results and predictions.
  [[nodiscard]] const std::string& frame(std::size_t index) const { return frames_[index]; }
  /// Returns the file with the frame's points, for messages.
  [[nodiscard]] std::filesystem::path file(std::size_t index) const {
    return folder_ / layout_.points.path(frames_[index]);
  }
  /// Reads a frame, on any thread. Errors name the file.
  [[nodiscard]] Status read(std::size_t index, LabelledScan& scan) const;
  /// Fails with kMalformed, naming the frames, if labels exist for missing frames.
  [[nodiscard]] Status check_whole() const;
  /// Returns the unit's rings, as far as the frames show them.
  [[nodiscard]] const scan::RingTable& rings() const { return table_; }
  /// Returns the spin rate of an HDL-64E's head, as far as the frames show it.
  [[nodiscard]] const encode::RecordedSpin& spin() const { return spin_; }
  /// Returns the shape of an image for a frame.
  [[nodiscard]] frame::ImageShape shape() const { return {layout_.rings, layout_.columns}; }

 private:
  [[nodiscard]] Status fit_rings();
  [[nodiscard]] Status fit_lasers();
  [[nodiscard]] Status read(std::size_t index, const scan::RingTable* table,
                            LabelledScan& scan) const;

  CloudLayout layout_;
  std::filesystem::path folder_;
  std::vector<std::string> frames_;
  cloud::RingOfLaser ring_of_laser_;  ///< Set if the points have laser numbers.
  scan::RingTable table_;
  encode::RecordedSpin spin_;
};

}  // namespace terracut::datasets
