// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calib/hdl64e_calibration.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "rt/error.hpp"

namespace terracut::evaluation {

/// One labelled turn. Buffers are kept from turn to turn.
struct LabelledScan {
  firmware_io::KittiScan scan;      ///< Sensor frame; as many labels as points.
  firmware_io::RingRecovery rings;  ///< The ring of every point.
};

/// Turns of one unit, in order of their names.
class Sequence {
 public:
  Sequence() = default;
  Sequence(const Sequence&) = delete;
  Sequence& operator=(const Sequence&) = delete;
  virtual ~Sequence() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;
  /// "000042": names a frame's results and predictions.
  [[nodiscard]] virtual std::string frame(std::size_t index) const = 0;
  /// The file with its points, for messages.
  [[nodiscard]] virtual std::filesystem::path file(std::size_t index) const = 0;
  /// From any thread. Errors name the file.
  [[nodiscard]] virtual Status read(std::size_t index, LabelledScan& scan) const = 0;
  /// kMalformed, naming them, when there are labels of scans that are not there.
  [[nodiscard]] virtual Status check_whole() const { return {}; }
  /// Of the unit, as far as its scans tell.
  [[nodiscard]] virtual const calib::Hdl64eCalibration& calibration() const = 0;
};

/// Labelled HDL-64E scans on disk.
class Dataset {
 public:
  Dataset() = default;
  Dataset(const Dataset&) = delete;
  Dataset& operator=(const Dataset&) = delete;
  virtual ~Dataset() = default;

  /// Names of the sequences that have labels, sorted. kNotFound, saying what was expected: none.
  [[nodiscard]] virtual Expected<std::vector<std::string>> sequences() const = 0;
  [[nodiscard]] virtual std::filesystem::path folder(const std::string& sequence) const = 0;
  /// Lists the sequence and learns its rings. Errors name file or folder.
  [[nodiscard]] virtual Expected<std::unique_ptr<Sequence>> open(
      const std::string& sequence) const = 0;
};

enum class DatasetLayout : std::uint8_t { kSemanticKitti, kKoblenz };

[[nodiscard]] std::unique_ptr<Dataset> dataset_at(DatasetLayout layout,
                                                  const std::filesystem::path& root);

}  // namespace terracut::evaluation
