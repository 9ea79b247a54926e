// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/remembered/street_grid.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/memory_report.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::remembered {

/// Gives the random field's energy a prior from earlier frames.
///
/// The prior decides only cells that the frame itself leaves nearly open. Seeds stay seeds, except
/// steep, low obstacles, which become unknown where earlier frames surely saw ground. A prior
/// weighs no more than a clear height, and beside anything tall now no cell is drawn towards
/// ground. So objects that appear, leave or move are decided by the present frame. The memory of a
/// cell is the mean of its label and of the evidence of its height: a label against a clear height
/// lasts a few frames; against evidence of less than a third (up to 0.18 m, where ground was
/// remembered) it stays.
///
/// If cells that are certain in this frame contradict certain memory, the motion is taken to be
/// wrong: everything is forgotten, and the frame is labelled by itself. Slightly wrong motion is
/// seldom noticed.
///
/// Takes all memory in the constructor. One thread; real-time safe.
class StreetMemory {
 public:
  struct Config {
    bool enabled = true;
    StreetGrid::Config grid;
    float weight = 1.0F;            ///< Weight of a sure memory, with a region term of 1; [0, 10].
    float reopen_height_m = 0.35F;  ///< Highest steep obstacle that may become unknown.
    float reopen_share = 0.2F;      ///< How sure of ground the memory must be for that, [0, 1].
    float tall_m = 0.35F;           ///< Beside anything this tall no cell is drawn to ground.
    /// If this share of the certain returns contradicts a certain memory, the motion is taken to be
    /// wrong.
    float max_contradiction = 0.2F;
  };

  StreetMemory(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Forgets all earlier frames.
  void forget() noexcept TERRACUT_NONBLOCKING;

  /// Finds the memory of the unknown cells of a frame whose sensor stands at `place`, and makes
  /// contradicted seeds unknown. Called before the cut; `points` must be valid in all cells.
  void look_back(const frame::Place& place, const frame::PointPlanes& points,
                 const stage::CellPlanes& planes,
                 std::span<min_cut::Seed> seeds) noexcept TERRACUT_NONBLOCKING;
  /// Returns the prior of an unknown cell, scaled by kCapacityScale.
  [[nodiscard]] min_cut::LabelCosts operator()(std::uint32_t cell) const noexcept {
    const std::int32_t for_ground = prior_[cell];
    return for_ground > 0 ? min_cut::LabelCosts{0, for_ground}
                          : min_cut::LabelCosts{-for_ground, 0};
  }
  /// Remembers the frame given to look_back(); called after the cut. `lean(cell)` is the evidence
  /// of an unknown cell's own height, from -1 (obstacle) to 1 (ground).
  template <class Lean>
  void remember(const stage::CellPlanes& planes, Lean&& lean) noexcept {
    for (std::size_t cell = 0; cell < box_.size(); ++cell) {
      if (box_[cell] == StreetGrid::kOutside) continue;
      const int label =
          frame::is_ground(planes.label[cell]) ? StreetGrid::kSure : -StreetGrid::kSure;
      int own = label;
      if (own_[cell] == kLow) own = -StreetGrid::kSure;
      if (own_[cell] == kOpen) own = static_cast<int>(lean(cell) * float{StreetGrid::kSure});
      grid_.add(box_[cell], (label + own) / 2);
    }
  }

  [[nodiscard]] const stage::MemoryReport& report() const noexcept { return report_; }

 private:
  /// The state of a cell, judged by the present frame alone.
  enum Own : std::uint8_t { kCertain, kOpen, kLow };

  void find_boxes(const frame::PointPlanes& points, const stage::CellPlanes& planes,
                  std::span<const min_cut::Seed> seeds) noexcept;
  [[nodiscard]] bool is_contradicted() const noexcept;
  void find_priors(const stage::CellPlanes& planes, std::span<min_cut::Seed> seeds) noexcept;
  [[nodiscard]] bool stands_beside_tall(std::uint32_t square) const noexcept;

  Config config_;
  StreetGrid grid_;
  std::uint32_t journey_ = 0;        ///< Journey of the memory; 0: no memory.
  std::span<std::uint32_t> box_;     ///< Box of each cell.
  std::span<std::int16_t> prior_;    ///< Per cell: positive for ground, negative against it.
  std::span<std::uint8_t> own_;      ///< By cell: a value of Own.
  std::span<std::uint8_t> is_tall_;  ///< By square: 1 if something tall is there in this frame.
  std::uint32_t agreed_ = 0, contradicted_ = 0;
  stage::MemoryReport report_;
};

}  // namespace terracut::remembered
