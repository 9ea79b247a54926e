// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/min_cut/open_components.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/portable_math.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The fine stages of the method, the random field and its cut, on a circle of columns that
/// CoarseStages labels: all at once, where it is one turn closed with itself, or turn after turn.
/// There components of unknown cells are cut as soon as no later column can join them, which gives
/// the labels of one cut of all columns; one that stays open for an eighth of a turn is cut as it
/// is.
///
/// All memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class FineStages {
 public:
  /// `profile` must have shape.rows rings.
  FineStages(const SegmenterConfig& config, const mount::RingProfile& profile,
             frame::ImageShape shape, memory::FixedMemory& memory);

  /// Forgets all turns and begins one.
  void begin() noexcept TERRACUT_NONBLOCKING;
  /// Makes the labels of a whole turn final. If `budget` expires early in the cut, the labels of
  /// the coarse stages stay.
  void label_circle(const frame::PointPlanes& points, stage::CellPlanes& planes,
                    const min_cut::CutBudget& budget,
                    stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// Begins the turn that follows a labelled one. Columns are counted from its beginning.
  void begin_next_turn() noexcept TERRACUT_NONBLOCKING;
  /// Goes on with the labels of columns before `coarse_columns`, which have their final coarse
  /// label. The budget's operations are for one turn.
  void label_to(int coarse_columns, const frame::PointPlanes& points, stage::CellPlanes& planes,
                const min_cut::CutBudget& budget,
                stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;
  /// Labels the columns before this one, which have their coarse label, without waiting for what
  /// follows them.
  void label_until(int column, const frame::PointPlanes& points, stage::CellPlanes& planes,
                   const min_cut::CutBudget& budget,
                   stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

  /// The turn's columns before this one have their final labels; below 0 if some of the turn before
  /// it have not.
  [[nodiscard]] int labelled_columns() const noexcept {
    return cut_columns_ - open_.waiting_columns();
  }
  /// Returns the report of all cuts since the last call.
  [[nodiscard]] min_cut::CutReport take_report() noexcept TERRACUT_NONBLOCKING;
  /// False if the random field needs a whole turn before its first label.
  [[nodiscard]] bool can_go_on() const noexcept {
    return !has_cut() || config_.region.rule != random_field::RegionRule::kHistogram;
  }

 private:
  /// Components are released by so many columns, so that labels do not depend on when columns came.
  static constexpr int kColumnsAtOnce = 40;
  /// Cells that can wait for their components to be closed; some hundred do on streets. When there
  /// are more, components are cut as they are.
  static constexpr std::size_t kOpenCells = 16'384;

  [[nodiscard]] bool has_cut() const noexcept {
    return config_.last_stage >= stage::Stage::kMinCut;
  }
  /// Chooses the seeds of columns before `end`.
  void select_to(int end, const frame::PointPlanes& points,
                 const stage::CellPlanes& planes) noexcept;
  /// Takes the unknown cells of columns before `end`, and cuts what no column after `end` can join.
  void cut_to(int end, const frame::PointPlanes& points, stage::CellPlanes& planes,
              const min_cut::CutBudget& budget) noexcept;
  void cut_released(const min_cut::OpenComponents::Released& released,
                    const frame::PointPlanes& points, stage::CellPlanes& planes,
                    const min_cut::CutBudget& budget) noexcept;
  void cut(min_cut::ColumnWindow window, const frame::PointPlanes& points,
           stage::CellPlanes& planes, const min_cut::CutBudget& budget) noexcept;
  /// Gives the unknown cells of the next column to cut another state.
  void change_next_column(min_cut::Seed from, min_cut::Seed to) noexcept;

  SegmenterConfig config_;
  frame::ImageShape shape_;
  stage::NegativeExp negative_exp_;
  random_field::ConfidenceSeeds seeds_;
  random_field::RegionTerm region_;
  min_cut::OpenComponents open_;
  min_cut::GridCut min_cut_;
  int seeded_columns_ = 0;  // columns of the turn before this one have seeds
  int cut_columns_ = 0;     // unknown cells before this column are cut or wait
  min_cut::CutReport report_;
  std::int64_t spent_ops_ = 0;  // of the turn's budget
};

}  // namespace terracut::ground
