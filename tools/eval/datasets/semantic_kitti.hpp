// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <utility>

#include "dataset.hpp"

namespace terracut::evaluation {

/// `root`/sequences/NN/{velodyne/NNNNNN.bin, labels/NNNNNN.label}. Rings are recovered from the
/// order of the points (firmware_io/scan/ring_recovery.hpp).
class SemanticKitti final : public Dataset {
 public:
  explicit SemanticKitti(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] Expected<std::vector<std::string>> sequences() const override;
  [[nodiscard]] std::filesystem::path folder(const std::string& sequence) const override {
    return root_ / "sequences" / sequence;
  }
  [[nodiscard]] Expected<std::unique_ptr<Sequence>> open(
      const std::string& sequence) const override;

 private:
  std::filesystem::path root_;
};

}  // namespace terracut::evaluation
