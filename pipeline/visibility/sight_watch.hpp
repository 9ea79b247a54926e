// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/visibility/sight_figures.hpp"
#include "pipeline/visibility/visibility.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::visibility {

/// Looks at a run's turns, one after the other, and keeps what is told of them, by directions of
/// the vehicle however the sensor stands. Takes all memory in the constructor; the rest is
/// real-time safe. One thread at a time.
class SightWatch {
 public:
  /// The arguments are Visibility's.
  SightWatch(const mount::RingProfile& profile, frame::ImageShape shape,
             memory::FixedMemory& memory);

  /// True if a turn has so many of its firings that few beams look lost whose packets are missing:
  /// nine of ten, because each such beam is missed for a turn and no more.
  [[nodiscard]] static bool is_whole(const frame::FrameInfo& info,
                                     frame::ImageShape shape) noexcept {
    const std::uint64_t holes = info.losses.azimuth_hole_columns;
    return info.complete || (holes > 0 && 10 * holes <= static_cast<std::uint64_t>(shape.columns));
  }

  /// Looks at the next turn; the arguments are those of Visibility::look(). A turn that is not
  /// whole is counted and not looked at.
  void look(const frame::RangeImage& image, const stage::CellPlanes& planes,
            bool is_whole) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const SightFigures& figures() const noexcept { return figures_; }

 private:
  bool is_counter_clockwise_;  ///< The columns are, because the sensor is upside down.
  Visibility visibility_;
  SightFigures figures_;
};

}  // namespace terracut::visibility
