// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"

namespace terracut::ground {

/// The coarse-to-fine method: a range image goes in, a label for every return comes out.
///
/// Memory is taken in the constructor and never again; nothing here allocates, locks, throws or
/// looks at a clock, and the same image gives the same labels on every machine (unless a budget
/// with a clock cuts the min-cut short). One thread at a time; on two threads, use both halves by
/// themselves.
class Segmenter {
 public:
  /// `profile` must have shape.rows rings. `return_capacity`: of the images to come. `reader`: of
  /// their sensor where they keep their returns as they were measured; else null.
  Segmenter(const SegmenterConfig& config, const mount::RingProfile& profile,
            frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
            std::unique_ptr<frame::TileReader> reader = nullptr)
      : planes_(shape, memory),
        made_(reader == nullptr
                  ? nullptr
                  : std::make_unique<frame::FramePoints>(shape, std::move(reader), memory)),
        coarse_(config, profile, shape, memory, made_.get()),
        fine_(config, profile, shape, return_capacity, memory, made_.get()) {}

  /// Does ahead what can be done of a frame that is still arriving: CoarseStages::advance(). Never
  /// necessary; labels are the same without it. Overwrites planes(), not labels().
  void advance(const frame::RangeImage& image, int complete_columns,
               stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING {
    coarse_.advance(image, complete_columns, planes_, observer);
  }

  /// Labels one frame; `image` has the shape given at construction. The result of the frame before
  /// is overwritten. `budget`: FineStages::refine(). Real-time safe if the observer is.
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::RangeImage& image, const min_cut::CutBudget& budget = {},
      stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING {
    coarse_.finish(image, planes_, observer);
    return fine_.refine(image, planes_, budget, observer);
  }

  /// Of the frame to be labelled next: FineStages::set_place().
  void set_place(const frame::Place& place) noexcept TERRACUT_NONBLOCKING {
    fine_.set_place(place);
  }

  /// Of the frame labelled last.
  void take_near_ground(const frame::RangeImage& image,
                        NearGround& ground) noexcept TERRACUT_NONBLOCKING {
    fine_.take_near_ground(image, planes_, ground);
  }

  /// One label a return, in order of arrival (RangeImage::return_index()). kGround is all ground,
  /// unless the road surface is asked for; then what is none of it is kOtherGround.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return fine_.labels(); }
  /// The same by cell, with the heights they were judged by; for pictures and measurements.
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept { return planes_; }

 private:
  stage::CellPlanes planes_;
  std::unique_ptr<frame::FramePoints> made_;  // where images have no points
  CoarseStages coarse_;
  FineStages fine_;
};

}  // namespace terracut::ground
