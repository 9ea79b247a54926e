// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "rt/error.hpp"

namespace terracut::output {

/// Returns a label's SemanticKITTI class in prediction files: 40 (road) for ground that is road or
/// undecided, 49 (other-ground) for ground that is not road, 99 (other-object) for obstacles, 0
/// (unlabelled) for kNone, which no return has.
[[nodiscard]] constexpr std::uint32_t semantic_kitti_class(frame::Label label) noexcept {
  switch (label) {
    case frame::Label::kGround:
      return 40;
    case frame::Label::kObstacle:
      return 99;
    case frame::Label::kOtherGround:
      return 49;
    case frame::Label::kNone:
      break;
  }
  return 0;
}

/// Writes one frame's labels as a SemanticKITTI prediction: one little-endian uint32 per return, in
/// the order of `labels` (order of arrival for packets, order of points for scans). The lower 16
/// bits are the class, the upper 16 the number of the return's object in the frame, if there are
/// `objects`, one number per label; 0: none. The file appears whole or not at all.
[[nodiscard]] Status write_label_file(const std::filesystem::path& path,
                                      std::span<const frame::Label> labels,
                                      std::span<const std::uint16_t> objects = {});

}  // namespace terracut::output
