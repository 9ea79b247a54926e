// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/sinks/frame_colours.hpp"
#include "firmware_io/sinks/frame_folder.hpp"
#include "firmware_io/sinks/png_picture.hpp"
#include "options.hpp"
#include "pipeline/label.hpp"
#include "pipeline/range_image.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Writes what OutputOptions asks for, frame by frame. `name` is a file name without extension.
class FrameOutputs {
 public:
  explicit FrameOutputs(const OutputOptions& options)
      : options_(options),
        labels_(options.labels, ".label"),
        pcd_(options.pcd, ".pcd"),
        png_(options.png, ".png") {}

  /// NAME.label, in the order of `labels`.
  [[nodiscard]] Status write_labels(const std::string& name,
                                    std::span<const pipeline::Label> labels);

  /// NAME.pcd, and NAME.birdseye.png and NAME.range.png; with truth also NAME.mistakes.png.
  /// `labels` and `truth` (SemanticKITTI ids, or empty) go by return index.
  [[nodiscard]] Status write_frame(const std::string& name, const pipeline::RangeImage& image,
                                   std::span<const pipeline::Label> labels,
                                   std::span<const std::uint32_t> truth);

 private:
  [[nodiscard]] Status draw(const std::string& name, const firmware_io::Picture& picture);

  OutputOptions options_;
  firmware_io::FrameFolder labels_, pcd_, png_;
  std::vector<firmware_io::Mistake> mistakes_;
};

}  // namespace terracut::cli
