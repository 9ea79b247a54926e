// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// A method that labels range images: Segmenter, or a method that Segmenter is compared with. Takes
/// all memory in its constructor; real-time safe if the observer is. For one thread.
class FrameMethod {
 public:
  virtual ~FrameMethod() = default;

  /// Labels one frame; `image` has the shape given at construction. Overwrites the previous frame's
  /// result. `budget` limits the time for a cut.
  [[nodiscard]] virtual stage::SegmentationReport segment(
      const frame::RangeImage& image, const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING = 0;

  /// Returns one label per return, in order of arrival (RangeImage::return_index()).
  [[nodiscard]] virtual std::span<const frame::Label> labels() const noexcept
      TERRACUT_NONBLOCKING = 0;
  /// True if the method gives heights; most methods do not.
  [[nodiscard]] virtual bool gives_heights() const noexcept { return false; }
  /// Returns the height above the ground of each return, metres, in the order of labels(); empty
  /// unless gives_heights().
  [[nodiscard]] virtual std::span<const float> heights_m() const noexcept TERRACUT_NONBLOCKING {
    return {};
  }
  /// Returns for each cell its label and the height that led to the label; for pictures.
  [[nodiscard]] virtual const stage::CellPlanes& planes() const noexcept = 0;
};

/// The properties of the frames that a method will label.
struct FramesToCome {
  const mount::RingProfile& profile;  ///< Must have shape.rows rings.
  frame::ImageShape shape;
  std::size_t return_capacity = 0;
  /// The sensor's tile reader for turns of measured returns; null for images of points.
  std::unique_ptr<frame::TileReader> reader = nullptr;
};

/// Makes a method in `memory`, which must outlive it.
using MethodMaker =
    std::function<std::unique_ptr<FrameMethod>(FramesToCome frames, memory::FixedMemory& memory)>;

}  // namespace terracut::ground
