// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/adjacent_points.hpp"
#include "pipeline/elevation/ring_elevation_map.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The coarse stages of the method, elevation map and adjacent points. Most of the work can be done
/// while the frame is arriving, on columns just written, which are in the caches next to the core:
///
///   columns   0 ......................................................... all
///             |  labelled  | traced: their lowest returns known |  to come  |
///                          '-- as many sectors as give ground to a neighbour --'
///
/// Later columns can change the ground of sectors already labelled: at the seam, where the circle
/// closes, and sometimes beside a strip too narrow to be ground. finish() labels those sectors
/// again. So the labels are bit for bit those of a frame that came at once, whatever was done ahead
/// and in whatever order packets came.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class CoarseStages {
 public:
  /// `profile` must have shape.rows rings; suited_to_rows() adapts `config` to it first. `made` is
  /// for images that keep their returns as measured, else null: it is filled ahead as columns are
  /// needed, and with all points by finish().
  CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, memory::FixedMemory& memory,
               frame::FramePoints* made = nullptr);

  /// Does work ahead for a frame that is still arriving: labels columns in blocks, at most
  /// `most_blocks` in this call. Columns [0, complete_columns) of `image` are complete and must not
  /// be moved any more. The labels go to `planes`, which belong to this frame until finish().
  /// Another image, or the same image cleared, begins another frame and drops the work for the last
  /// one.
  void advance(const frame::RangeImage& image, int complete_columns, stage::CellPlanes& planes,
               stage::StageObserver* observer = nullptr,
               int most_blocks = kAnyNumber) noexcept TERRACUT_NONBLOCKING;
  /// Returns the share of a frame's sectors, [0, 1], that finish() would find labelled.
  [[nodiscard]] float share_ahead(const frame::RangeImage& image) const noexcept
      TERRACUT_NONBLOCKING {
    if (!has_begun(image)) return 0;
    return static_cast<float>(labelled_) / static_cast<float>(map_.grid().sectors());
  }

  /// Completes a whole frame: fills `height_m`, `label` and, if adjacent points are among the
  /// stages, `steep` of every cell.
  void finish(const frame::RangeImage& image, stage::CellPlanes& planes,
              stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

 private:
  /// A configuration already adapted to the rows.
  struct Suited {
    SegmenterConfig config;
  };
  CoarseStages(const Suited& suited, const mount::RingProfile& profile, frame::ImageShape shape,
               memory::FixedMemory& memory, frame::FramePoints* made);

  static constexpr int kAnyNumber = std::numeric_limits<int>::max();

  void begin(const frame::RangeImage& image) noexcept;
  void trace_to(int end, const frame::RangeImage& image) noexcept;
  [[nodiscard]] frame::PointPlanes points_of(const frame::RangeImage& image) const noexcept {
    return made_ != nullptr ? made_->planes() : image.points();
  }
  [[nodiscard]] bool has_begun(const frame::RangeImage& image) const noexcept {
    return image_ == &image && generation_ == image.generation();
  }
  /// Labels sectors for the first time. Those to their left are labelled already, or will be by
  /// label_again(), which compares them with their neighbours once more.
  void label(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
             stage::CellPlanes& planes, stage::StageObserver* observer) noexcept;
  /// Labels sectors again in a labelled frame.
  void label_again(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
                   stage::CellPlanes& planes) noexcept;
  /// Labels the changed ones of the sectors [0, end) again.
  void label_changed(int end, const frame::RangeImage& image, stage::CellPlanes& planes) noexcept;
  [[nodiscard]] bool uses_adjacent_points() const noexcept {
    return last_stage_ >= stage::Stage::kAdjacentPoints;
  }

  stage::Stage last_stage_;
  frame::ImageShape shape_;
  elevation::RingElevationMap map_;
  elevation::AdjacentPoints adjacent_;
  frame::FramePoints* made_;
  const frame::RangeImage* image_ = nullptr;  // the frame in work
  std::uint32_t generation_ = 0;
  int labelled_ = 0;                    // sectors
  std::span<std::uint8_t> is_current_;  // by sector: labelled by the present surface
};

}  // namespace terracut::ground
