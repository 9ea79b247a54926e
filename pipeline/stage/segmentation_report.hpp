// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/cut_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// The result of segmenting one frame, in numbers.
struct SegmentationReport {
  std::uint32_t returns = 0;       ///< All returns of the image; all are labelled.
  std::uint32_t ground = 0;        ///< Returns labelled ground of either kind.
  std::uint32_t other_ground = 0;  ///< Ground that is not road surface.
  std::uint32_t obstacles = 0;     ///< Returns labelled obstacle.
  /// Cells whose return lies two obstacle heights or more below the ground: ghosts, or a hole.
  std::uint32_t below = 0;
  /// Returns that came after their columns were labelled, into empty cells: judged by their height.
  std::uint32_t late = 0;
  Stage last_stage = Stage::kMinCut;  ///< The last stage that ran.
  min_cut::CutReport cut;             ///< All zero if there was no cut.

  [[nodiscard]] constexpr std::uint32_t labelled() const noexcept { return ground + obstacles; }
  /// Fills in the four counts above, given one label per return.
  void count(std::span<const frame::Label> labels) noexcept TERRACUT_NONBLOCKING;
};

/// Returns how many heights lie below `limit_m`; NaN does not.
[[nodiscard]] std::uint32_t count_below(std::span<const float> height_m,
                                        float limit_m) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::stage
