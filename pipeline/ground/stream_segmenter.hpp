// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "firmware_io/frame/point_ring.hpp"
#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/ground/turn_method.hpp"
#include "pipeline/stage/return_heights.hpp"

namespace terracut::ground {

/// How many sectors are waited for before they are taken together; labels are the same.
enum class Pace : std::uint8_t {
  kThroughput,  ///< Sixteen: long loops cost less.
  kLatency,     ///< Four: each is labelled early.
};

/// The coarse-to-fine method on a stream of turns: labels every return some milliseconds after it
/// was measured, wherever a turn begins or ends.
///
///   columns   ... the turn before | 0 ........................................... this turn
///             ------ labelled ------>| seeds ->| coarse labels ->|  lowest returns ->|  to come
///
/// A turn that follows no other one is labelled when it is whole, as a circle closed with itself
/// (the labels of Segmenter); the end of a turn that no other one follows is labelled by close().
/// Labels depend on the columns alone, not on when they came; except for returns that come late,
/// after their columns were taken. These are labelled, too, and counted.
///
/// All memory is taken in the constructor; no other function allocates, locks, throws or looks at a
/// clock. One thread.
class StreamSegmenter final : public TurnMethod {
 public:
  /// `profile` must have shape.rows rings. `return_capacity` is the most returns of a turn;
  /// `reader` is the sensor's.
  StreamSegmenter(const SegmenterConfig& config, Pace pace, const mount::RingProfile& profile,
                  frame::ImageShape shape, std::size_t return_capacity,
                  std::unique_ptr<frame::TileReader> reader, memory::FixedMemory& memory);

  void advance(const frame::MeasuredReturns& turn, int complete_columns,
               const min_cut::CutBudget& budget,
               stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;
  void end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;
  void close(const min_cut::CutBudget& budget,
             stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;

  [[nodiscard]] const frame::MeasuredReturns* labelled() const noexcept
      TERRACUT_NONBLOCKING override {
    return labelled_;
  }
  void release() noexcept TERRACUT_NONBLOCKING override;
  [[nodiscard]] const frame::MeasuredReturns* at_work() const noexcept
      TERRACUT_NONBLOCKING override {
    if (labelled_ != nullptr) return labelled_;
    return next_tile_ > 0 ? unlabelled_[0] : nullptr;
  }
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept
      TERRACUT_NONBLOCKING override {
    return return_labels_.labels();
  }
  [[nodiscard]] std::span<const float> heights_m() const noexcept TERRACUT_NONBLOCKING override {
    return return_heights_ ? return_heights_->heights_m() : std::span<const float>();
  }
  void watch_near_ground(NearGround* ground) noexcept TERRACUT_NONBLOCKING override {
    near_ground_ = ground;
  }
  [[nodiscard]] const stage::SegmentationReport& report() const noexcept
      TERRACUT_NONBLOCKING override {
    return report_;
  }

  /// True if the method can label this sensor's turns as a stream, not only each turn by itself.
  [[nodiscard]] bool can_go_on() const noexcept { return coarse_.can_go_on() && fine_.can_go_on(); }

 private:
  /// Columns are taken in blocks of at most so many sectors.
  static constexpr int kMostSectors = 16;

  /// Makes `turn` the newest, if it is not.
  void begin_if_new(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                    stage::StageObserver* observer) noexcept;
  /// Takes the newest turn's columns before this sector, and labels what these make known.
  void take_to(int sector, const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
               stage::StageObserver* observer) noexcept;
  /// Labels the returns whose columns have their final labels, up to the end of a turn.
  void label_returns(stage::StageObserver* observer) noexcept;
  /// Notes what is counted by columns, for columns of the oldest unlabelled turn before `end`.
  void count_to(int end) noexcept;

  frame::ImageShape shape_;
  int least_sectors_;  // of a block
  stage::Stage last_stage_;
  float below_m_;
  stage::CellPlanes planes_;
  frame::PointRing points_;
  CoarseStages coarse_;
  FineStages fine_;
  stage::ReturnLabels return_labels_;
  std::optional<stage::ReturnHeights> return_heights_;  // empty unless asked for

  bool has_begun_ = false;  // there is a newest turn
  std::int64_t newest_ = 0;
  bool is_whole_ = false;   // all of the newest turn has come
  bool is_circle_ = false;  // the newest turn is labelled by itself
  // The turns of which returns have no label yet, the older one first.
  std::array<const frame::MeasuredReturns*, 2> unlabelled_{};
  const frame::MeasuredReturns* labelled_ = nullptr;
  // Of the oldest unlabelled turn:
  std::size_t next_tile_ = 0;
  int counted_columns_ = 0;
  NearGround* near_ground_ = nullptr;
  stage::SegmentationReport report_;
};

/// Returns a function that makes the method for turns: a StreamSegmenter, or, with road.enabled,
/// a Segmenter that labels each turn by itself.
[[nodiscard]] TurnMethodMaker turn_maker_of(const SegmenterConfig& config,
                                            Pace pace = Pace::kThroughput);

}  // namespace terracut::ground
