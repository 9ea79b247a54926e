// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/sinks/frame_colours.hpp"
#include "options.hpp"
#include "pipeline/label.hpp"
#include "pipeline/range_image.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Writes what OutputOptions asks for, frame by frame. `name` is a file name without extension.
class FrameOutputs {
 public:
  explicit FrameOutputs(const OutputOptions& options) : options_(options) {}

  /// NAME.label, in the order of `labels`.
  [[nodiscard]] Status write_labels(const std::string& name,
                                    std::span<const pipeline::Label> labels) const;

  /// NAME.pcd, and NAME.birdseye.png and NAME.range.png; with truth also NAME.mistakes.png.
  /// `labels` and `truth` (SemanticKITTI ids, or empty) go by return index.
  [[nodiscard]] Status write_frame(const std::string& name, const pipeline::RangeImage& image,
                                   std::span<const pipeline::Label> labels,
                                   std::span<const std::uint32_t> truth);

 private:
  OutputOptions options_;
  std::vector<firmware_io::Mistake> mistakes_;
};

}  // namespace terracut::cli
