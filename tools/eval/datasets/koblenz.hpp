// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>
#include <utility>

#include "dataset.hpp"

namespace terracut::evaluation {

/// The Koblenz data (KoblenzForestMap, KoblenzCampusMap, KoblenzFarmMap), as PCD files:
///
///   `root`/KoblenzForestMap/*.pcd    one turn a file; every folder with .pcd files is a sequence
///
///   x y z        sensor frame, metres: x forward, y left, z up
///   laser        0..63, or `ring`: which laser, in whatever order they are numbered
///   label        id of the class table: 0 unknown, 1 street, 2 rough, 3 obstacle
///   intensity    0..255, optional
///
/// The format in which the data were published could not be found (docs/evaluation.md); this one
/// names its fields, so that nothing in it has to be guessed.
///
/// Rings come from the laser numbers, put in order by the elevations measured under them.
class Koblenz final : public Dataset {
 public:
  explicit Koblenz(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] Expected<std::vector<std::string>> sequences() const override;
  [[nodiscard]] std::filesystem::path folder(const std::string& sequence) const override {
    return root_ / sequence;
  }
  /// kMalformed also where the points of a laser do not lie on its cone around the origin, as in a
  /// map's frame.
  [[nodiscard]] Expected<std::unique_ptr<Sequence>> open(
      const std::string& sequence) const override;

 private:
  std::filesystem::path root_;
};

/// What users of it are told with every evaluation.
extern const std::string_view kKoblenzFormatNote;

}  // namespace terracut::evaluation
