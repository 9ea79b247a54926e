// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/min_cut/near_unknown.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The fine stage of the method: the random field, its cut, and the labels of returns that follow.
/// Continues after CoarseStages, on the same thread or another one.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class FineStages {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is that of the images to come. `made`
  /// is like that of CoarseStages, on this thread; it is filled where needed, unless it has all
  /// points.
  FineStages(const SegmenterConfig& config, const mount::RingProfile& profile,
             frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
             frame::FramePoints* made = nullptr);

  /// Sets the sensor's place in the frame that refine() is called for next, whose image must have
  /// all its points: that frame is then labelled with memory of earlier frames. Without a place it
  /// is labelled by itself, and earlier frames are forgotten.
  void set_place(const frame::Place& place) noexcept TERRACUT_NONBLOCKING { place_ = place; }

  /// Labels the returns of a frame. CoarseStages::finish() must have filled `planes`; their labels
  /// become final. If `budget` expires before the random field, or too soon in its cut, labels stay
  /// as they were.
  [[nodiscard]] stage::SegmentationReport refine(
      const frame::RangeImage& image, stage::CellPlanes& planes,
      const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// Takes near ground from a frame that was labelled into `planes`.
  void take_near_ground(const frame::RangeImage& image, const stage::CellPlanes& planes,
                        NearGround& ground) noexcept TERRACUT_NONBLOCKING;

  /// See Segmenter::labels().
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return return_labels_.labels();
  }

 private:
  /// Returns what was remembered of the cells to be cut; null without motion.
  [[nodiscard]] const remembered::StreetMemory* look_back(const frame::RangeImage& image,
                                                          const stage::CellPlanes& planes) noexcept;
  [[nodiscard]] min_cut::CutReport cut(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                       const remembered::StreetMemory* memory,
                                       const min_cut::CutBudget& budget) noexcept;
  /// Returns the points that later stages need: with a cut, those next to unknown cells.
  [[nodiscard]] frame::PointPlanes points_of(const frame::RangeImage& image, bool has_cut) noexcept;

  SegmenterConfig config_;
  frame::ImageShape shape_;
  stage::NegativeExp negative_exp_;
  random_field::ConfidenceSeeds seeds_;
  random_field::RegionTerm region_;
  frame::FramePoints* made_;
  min_cut::NearUnknown near_unknown_;
  min_cut::GridCut min_cut_;
  stage::ReturnLabels return_labels_;
  std::optional<remembered::StreetMemory> memory_;  // empty unless enabled
  frame::Place place_;                              // of the next frame
  std::optional<road::RoadSurface> road_surface_;   // empty unless enabled
};

}  // namespace terracut::ground
