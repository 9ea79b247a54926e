// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rt/error.hpp"

namespace terracut::cli {

/// Reads the true labels of frames from a folder of NNNNNN.label files.
class FrameTruth {
 public:
  /// Without a `folder` there is no truth. Fails with kNotFound, naming --truth, if it is no folder
  /// of such files.
  [[nodiscard]] static Expected<FrameTruth> open(const std::filesystem::path& folder);

  [[nodiscard]] bool exists() const noexcept { return !folder_.empty(); }
  /// Reads the true class of each return of a frame. Without truth, and with the errors of
  /// scan::read_label_file(), labels() are empty.
  [[nodiscard]] Status read(const std::string& name, std::size_t returns);
  [[nodiscard]] std::span<const std::uint32_t> labels() const noexcept { return labels_; }

 private:
  explicit FrameTruth(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::vector<std::uint32_t> labels_;
};

}  // namespace terracut::cli
