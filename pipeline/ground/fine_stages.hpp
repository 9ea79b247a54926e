// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "firmware_io/frame/frame_returns.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/min_cut/near_unknown.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The fine stages of the method: the random field, its cut, and the final labels of the returns.
/// They continue after CoarseStages, on the same thread or another one.
///
/// All memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class FineStages {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of a frame.
  /// `made` is as in CoarseStages, but for this thread; it computes only the points needed that are
  /// missing.
  FineStages(const SegmenterConfig& config, const mount::RingProfile& profile,
             frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
             frame::FramePoints* made = nullptr);

  /// Labels the returns of a frame for which CoarseStages::finish() has filled `planes`, and makes
  /// the labels in `planes` final. If `budget` expires before the random field, or early in the
  /// cut, the labels of the coarse stages stay.
  [[nodiscard]] stage::SegmentationReport refine(
      const frame::FrameReturns& frame, stage::CellPlanes& planes,
      const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// Fills `ground` with near ground from a frame that was labelled into `planes`.
  void take_near_ground(const frame::FrameReturns& frame, const stage::CellPlanes& planes,
                        NearGround& ground) noexcept TERRACUT_NONBLOCKING;

  /// Returns one label per return; see Segmenter::labels().
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return return_labels_.labels();
  }

 private:
  [[nodiscard]] min_cut::CutReport cut(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                       const min_cut::CutBudget& budget) noexcept;
  /// Returns the points that later stages need: if there is a cut, usually only those next to
  /// unknown cells.
  [[nodiscard]] frame::PointPlanes points_of(const frame::FrameReturns& frame,
                                             bool has_cut) noexcept;

  /// Returns all points, for the road surface.
  [[nodiscard]] const frame::RangeImage& image_of(const frame::FrameReturns& frame) noexcept;

  SegmenterConfig config_;
  frame::ImageShape shape_;
  stage::NegativeExp negative_exp_;
  random_field::ConfidenceSeeds seeds_;
  random_field::RegionTerm region_;
  frame::FramePoints* made_;
  min_cut::NearUnknown near_unknown_;
  min_cut::GridCut min_cut_;
  stage::ReturnLabels return_labels_;
  std::optional<road::RoadSurface> road_surface_;  // empty unless enabled
  std::optional<frame::RangeImage> road_points_;   // set if frames are measured and it is enabled
};

}  // namespace terracut::ground
