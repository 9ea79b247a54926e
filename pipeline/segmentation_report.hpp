// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/label.hpp"
#include "pipeline/min_cut/cut_report.hpp"
#include "pipeline/stage.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// What became of one frame.
struct SegmentationReport {
  std::uint32_t returns = 0;          ///< In the image, all of them labelled.
  std::uint32_t ground = 0;           ///< Of them, labelled ground.
  std::uint32_t obstacles = 0;        ///< Of them, labelled obstacle.
  Stage last_stage = Stage::kMinCut;  ///< How far the labels were refined.
  CutReport cut;                      ///< All zero where none was tried.

  /// Fills the three counts from one label a return.
  void count(std::span<const Label> labels) noexcept TERRACUT_NONBLOCKING;
};

}  // namespace terracut::pipeline
