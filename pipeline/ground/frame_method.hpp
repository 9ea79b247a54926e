// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::ground {

/// A method from range images to labels, whichever it is: Segmenter, or what it is compared with.
/// Takes all memory in its constructor; real-time safe if the observer is. One thread.
class FrameMethod {
 public:
  virtual ~FrameMethod() = default;

  /// Does ahead what can be done of a frame that is still arriving; nothing by default. Never
  /// necessary; labels are the same without it. Overwrites planes(), not labels().
  virtual void advance(const frame::RangeImage& /*image*/, int /*complete_columns*/,
                       stage::StageObserver* /*observer*/ = nullptr) noexcept {}

  /// Labels one frame; `image` has the shape given at construction. The result of the frame before
  /// is overwritten. `budget`: what of a cut there is time for.
  [[nodiscard]] virtual stage::SegmentationReport segment(
      const frame::RangeImage& image, const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept = 0;

  /// Says where the sensor stands in the frame to be labelled next. Nothing to a method that labels
  /// each frame by itself.
  virtual void set_place(const frame::Place& /*place*/) noexcept {}

  /// Fills `ground` from the frame labelled last. By default `image` must have points.
  virtual void take_near_ground(const frame::RangeImage& image, NearGround& ground) noexcept {
    ground::take_near_ground(image, ground);
  }

  /// One label a return, in order of arrival (RangeImage::return_index()).
  [[nodiscard]] virtual std::span<const frame::Label> labels() const noexcept = 0;
  /// The same by cell, with the heights they were judged by; for pictures and measurements.
  [[nodiscard]] virtual const stage::CellPlanes& planes() const noexcept = 0;
};

/// What is known of the frames that a method will label.
struct FramesToCome {
  const mount::RingProfile& profile;  ///< Has shape.rows rings.
  frame::ImageShape shape;
  std::size_t return_capacity = 0;
  bool motion_is_known = false;  ///< Places will be set.
  /// Of their sensor, where images keep their returns as they were measured; else null.
  std::unique_ptr<frame::TileReader> reader = nullptr;
};

/// Makes a method in `memory`, which must outlive it.
using MethodMaker =
    std::function<std::unique_ptr<FrameMethod>(FramesToCome frames, memory::FixedMemory& memory)>;

}  // namespace terracut::ground
