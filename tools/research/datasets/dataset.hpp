// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cloud_layout.hpp"
#include "rt/error.hpp"
#include "sequence.hpp"

namespace terracut::datasets {

/// Labelled clouds on disk, in their layout.
class Dataset {
 public:
  /// Fails with kUnsupported if the layout takes rings from the order of points and the sensor has
  /// not 64 of them.
  [[nodiscard]] static Expected<Dataset> at(const CloudLayout& layout, std::filesystem::path root);

  /// Returns the names of the sequences with labels, sorted. Fails with kNotFound if there is none.
  [[nodiscard]] Expected<std::vector<std::string>> sequences() const;
  [[nodiscard]] std::filesystem::path folder(const std::string& sequence) const {
    return root_ / layout_.sequences.path(sequence);
  }
  [[nodiscard]] Expected<Sequence> open(const std::string& sequence) const {
    return Sequence::open(layout_, folder(sequence));
  }

 private:
  Dataset(CloudLayout layout, std::filesystem::path root)
      : layout_(std::move(layout)), root_(std::move(root)) {}

  CloudLayout layout_;
  std::filesystem::path root_;
};

}  // namespace terracut::datasets
