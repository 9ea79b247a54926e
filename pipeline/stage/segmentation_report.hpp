// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/cut_report.hpp"
#include "pipeline/stage/memory_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// What became of one frame.
struct SegmentationReport {
  std::uint32_t returns = 0;          ///< In the image, all of them labelled.
  std::uint32_t ground = 0;           ///< Of them, labelled ground of either kind.
  std::uint32_t other_ground = 0;     ///< Of the ground, told to be no road surface.
  std::uint32_t obstacles = 0;        ///< Of them, labelled obstacle.
  Stage last_stage = Stage::kMinCut;  ///< How far the labels were refined.
  min_cut::CutReport cut;             ///< All zero where none was tried.
  MemoryReport memory;                ///< Nothing was remembered where motion is not known.

  [[nodiscard]] constexpr std::uint32_t labelled() const noexcept { return ground + obstacles; }
  /// Fills the four counts from one label a return.
  void count(std::span<const frame::Label> labels) noexcept TERRACUT_NONBLOCKING;
};

}  // namespace terracut::stage
