// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "calib/ring_profile.hpp"
#include "pipeline/adjacent_points.hpp"
#include "pipeline/cell_planes.hpp"
#include "pipeline/profile.hpp"
#include "pipeline/range_image.hpp"
#include "pipeline/ring_elevation_map.hpp"
#include "pipeline/stage.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// The coarse stages of the method, elevation map and adjacent points. Most of their work can be
/// done while the turn is still arriving, on columns that were just written and are in the caches
/// next to the core:
///
///   columns   0 ......................................................... all
///             |  labelled  | walked: their lowest returns known |  to come  |
///                          '-- as many sectors as lend ground --'
///
/// Where what came later tells otherwise (the seam, where the circle closes; now and then a strip
/// too narrow to be ground), finish() labels those sectors again: the labels are, bit for bit,
/// those of the whole turn at once, whatever was done ahead, and in whatever order packets came.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class CoarseStages {
 public:
  /// `profile` must have shape.rows rings.
  CoarseStages(const SegmenterConfig& config, const calib::RingProfile& profile, ImageShape shape,
               rt::FixedMemory& memory);

  /// A turn is arriving: columns [0, settled_columns) of its image are not expected to change any
  /// more, and must not be moved. Does what can be done ahead, a block of columns at a time, into
  /// `planes`, which are the turn's own until finish(). Another image, or the same one cleared, is
  /// another turn; what was done for the one before is forgotten. No more than `most_blocks` are
  /// done now: what one call may cost.
  void advance(const RangeImage& image, int settled_columns, CellPlanes& planes,
               StageObserver* observer = nullptr,
               int most_blocks = kAnyNumber) noexcept TERRACUT_NONBLOCKING;
  /// The share of a turn's sectors, [0, 1], that finish() would find labelled.
  [[nodiscard]] float share_ahead(const RangeImage& image) const noexcept TERRACUT_NONBLOCKING {
    if (!has_begun(image)) return 0;
    return static_cast<float>(labelled_) / static_cast<float>(map_.grid().sectors());
  }

  /// The turn is whole: fills `height_m`, `label` and, where the adjacent points are among the
  /// stages, `steep` of every cell.
  void finish(const RangeImage& image, CellPlanes& planes,
              StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr int kAnyNumber = std::numeric_limits<int>::max();

  void begin(const RangeImage& image) noexcept;
  [[nodiscard]] bool has_begun(const RangeImage& image) const noexcept {
    return image_ == &image && generation_ == image.generation();
  }
  /// Labels sectors for the first time. Those to the left of them are labelled, or will be by
  /// label_again(), which compares them with their neighbours once more.
  void label(RingGrid::Sectors sectors, const RangeImage& image, CellPlanes& planes,
             StageObserver* observer) noexcept;
  /// Labels sectors again in a turn that is labelled.
  void label_again(RingGrid::Sectors sectors, const RangeImage& image, CellPlanes& planes) noexcept;
  /// Labels again what has changed in the sectors [0, end).
  void label_changed(int end, const RangeImage& image, CellPlanes& planes) noexcept;
  [[nodiscard]] bool uses_adjacent_points() const noexcept {
    return last_stage_ >= Stage::kAdjacentPoints;
  }

  Stage last_stage_;
  ImageShape shape_;
  RingElevationMap map_;
  AdjacentPoints adjacent_;
  const RangeImage* image_ = nullptr;  // of the turn that has begun
  std::uint32_t generation_ = 0;
  int labelled_ = 0;                    // sectors
  std::span<std::uint8_t> is_current_;  // of each sector: labelled by the surface as it is
};

}  // namespace terracut::pipeline
