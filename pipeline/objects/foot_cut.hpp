// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/grid_cut.hpp"
#include "pipeline/objects/parts.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Divides obstacle returns into bodies and feet by an exact minimum cut. Higher returns are body.
/// Each low return is rather a foot, the more so the lower it is, but goes with the body where it
/// hangs together with it on most sides: the lowest returns of a car 20 m away do, and the grass
/// around a post does not. What is low by itself is all foot.
///
///   E = sum over low body cells of body_cost * (1 - height / low_m)
///     + sum over neighbours of which one is body and one foot of (1 - distance^2 / reach^2)
class FootCut {
 public:
  struct Config {
    float low_m = 0.30F;     ///< Obstacle returns below this height above the ground are in doubt.
    float body_cost = 2.5F;  ///< Cost of a return at the height of the ground as body.
  };

  FootCut(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Returns the part of each cell, valid until the next call. Real-time safe.
  [[nodiscard]] std::span<const Part> divide(const frame::RangeImage& image,
                                             const stage::CellPlanes& planes,
                                             const Reach& reach) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] const min_cut::CutReport& report() const noexcept { return report_; }

 private:
  void plant(const stage::CellPlanes& planes) noexcept;

  Config config_;
  frame::ImageShape shape_;
  min_cut::GridCut cut_;
  min_cut::CutReport report_;
  std::span<min_cut::Seed> seeds_;
  std::span<frame::Label> sides_;  // of low cells
  std::span<Part> parts_;
};

}  // namespace terracut::objects
