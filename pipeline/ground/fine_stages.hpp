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

/// The fine stage of the method, the random field and its cut, and what makes labels of returns of
/// it. Begins where CoarseStages ends, on the same thread or another one.
///
/// Memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class FineStages {
 public:
  /// `profile` must have shape.rows rings. `return_capacity`: of the images to come. `made`: as
  /// CoarseStages, on this thread; filled where it is needed, unless it has the frame's points.
  FineStages(const SegmenterConfig& config, const mount::RingProfile& profile,
             frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
             frame::FramePoints* made = nullptr);

  /// Labels the returns of a frame. `planes`: what CoarseStages::finish() made of it; labels in
  /// them become final. Where `budget` has expired before the random field, or too soon in its cut,
  /// labels stay as they were.
  /// Where the sensor stands in the frame that refine() is called for next, whose image has all its
  /// points: it is labelled by what the frames before saw, too. Without this it is labelled by
  /// itself, and they are forgotten.
  void set_place(const frame::Place& place) noexcept TERRACUT_NONBLOCKING { place_ = place; }

  [[nodiscard]] stage::SegmentationReport refine(
      const frame::RangeImage& image, stage::CellPlanes& planes,
      const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// Of a frame that was labelled: `planes` are its.
  void take_near_ground(const frame::RangeImage& image, const stage::CellPlanes& planes,
                        NearGround& ground) noexcept TERRACUT_NONBLOCKING;

  /// As Segmenter::labels().
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return return_labels_.labels();
  }

 private:
  /// What was remembered of the cells that the cut is to label; null without motion.
  [[nodiscard]] const remembered::StreetMemory* look_back(const frame::RangeImage& image,
                                                          const stage::CellPlanes& planes) noexcept;
  [[nodiscard]] min_cut::CutReport cut(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                       const remembered::StreetMemory* memory,
                                       const min_cut::CutBudget& budget) noexcept;
  /// The points that the stages to come look at: next to unknown cells, if there is a cut.
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
  std::optional<remembered::StreetMemory> memory_;  // where it is asked for
  frame::Place place_;                              // of the frame to come
  std::optional<road::RoadSurface> road_surface_;   // where it is asked for
};

}  // namespace terracut::ground
