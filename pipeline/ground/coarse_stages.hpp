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

/// The coarse stages of the method, elevation map and adjacent points. Most of their work can be
/// done while the frame is still arriving, on columns that were just written and are in the caches
/// next to the core:
///
///   columns   0 ......................................................... all
///             |  labelled  | traced: their lowest returns known |  to come  |
///                          '-- as many sectors as give ground to a neighbour --'
///
/// Columns that come later can change the ground of sectors that were labelled: at the seam, where
/// the circle closes, and now and then beside a strip too narrow to be ground. finish() labels
/// those sectors again. The labels therefore are the same, bit for bit, as if the whole frame had
/// come at once, whatever was done ahead and in whatever order packets came.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class CoarseStages {
 public:
  /// `profile` must have shape.rows rings, which `config` is suited to first (suited_to_rows()).
  /// `made`: for images that keep their returns as they were measured; filled ahead as columns are
  /// needed, and with all points by finish(). Else null.
  CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, memory::FixedMemory& memory,
               frame::FramePoints* made = nullptr);

  /// Does what can be done ahead for a frame that is still arriving: labels columns in blocks, at
  /// most `most_blocks` of them in this call. Columns [0, complete_columns) of `image` are complete
  /// and must not be moved any more. The labels go to `planes`, which belong to this frame until
  /// finish(). Another image, or the same image cleared, begins another frame and drops what was
  /// done for the one before.
  void advance(const frame::RangeImage& image, int complete_columns, stage::CellPlanes& planes,
               stage::StageObserver* observer = nullptr,
               int most_blocks = kAnyNumber) noexcept TERRACUT_NONBLOCKING;
  /// The share of a frame's sectors, [0, 1], that finish() would find labelled.
  [[nodiscard]] float share_ahead(const frame::RangeImage& image) const noexcept
      TERRACUT_NONBLOCKING {
    if (!has_begun(image)) return 0;
    return static_cast<float>(labelled_) / static_cast<float>(map_.grid().sectors());
  }

  /// The frame is whole: fills `height_m`, `label` and, where the adjacent points are among the
  /// stages, `steep` of every cell.
  void finish(const frame::RangeImage& image, stage::CellPlanes& planes,
              stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

 private:
  /// A configuration that is suited to the rows.
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
  /// Labels sectors for the first time. Those to the left of them are labelled, or will be by
  /// label_again(), which compares them with their neighbours once more.
  void label(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
             stage::CellPlanes& planes, stage::StageObserver* observer) noexcept;
  /// Labels sectors again in a frame that is labelled.
  void label_again(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
                   stage::CellPlanes& planes) noexcept;
  /// Labels again what has changed in the sectors [0, end).
  void label_changed(int end, const frame::RangeImage& image, stage::CellPlanes& planes) noexcept;
  [[nodiscard]] bool uses_adjacent_points() const noexcept {
    return last_stage_ >= stage::Stage::kAdjacentPoints;
  }

  stage::Stage last_stage_;
  frame::ImageShape shape_;
  elevation::RingElevationMap map_;
  elevation::AdjacentPoints adjacent_;
  frame::FramePoints* made_;
  const frame::RangeImage* image_ = nullptr;  // of the frame that has begun
  std::uint32_t generation_ = 0;
  int labelled_ = 0;                    // sectors
  std::span<std::uint8_t> is_current_;  // of each sector: labelled by the surface as it is
};

}  // namespace terracut::ground
