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

/// The street as the frames before saw it, as a prior in the energy of the random field.
///
/// It tips what a frame by itself leaves nearly open, and nothing else: seeds stay seeds, but for
/// obstacles that are steep and low, which become unknown where the frames before surely saw
/// ground; a prior is worth no more than a clear height; and nothing is drawn towards ground beside
/// anything tall that stands there now. So what appears, leaves or moves is decided by its own
/// frame. What is remembered of a cell is the mean of its label and of what its own height says, so
/// that a label against a clear height lasts for a few frames; against one that says less than a
/// third (up to 0.18 m, where ground was remembered) it stays.
///
/// The motion is doubted where what is certain in this frame contradicts what was certain before:
/// then everything is forgotten, and the frame is labelled by itself. Motion that is merely wrong
/// seldom gets there.
///
/// Takes its memory in the constructor. One thread; real-time safe.
class StreetMemory {
 public:
  struct Config {
    bool enabled = true;
    StreetGrid::Config grid;
    float weight = 1.0F;           ///< Of a sure memory, against a full region term of 1; [0, 10].
    float reopen_height_m = 0.35F;  ///< Steep obstacles up to this height may become unknown ...
    float reopen_share = 0.2F;     ///< ... where memory says ground at least so surely, [0, 1].
    float tall_m = 0.35F;          ///< Beside what is so tall nothing is drawn towards ground.
    /// Share of certain returns that contradict a certain memory, from which on the motion is
    /// wrong.
    float max_contradiction = 0.2F;
  };

  StreetMemory(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Nothing is known of the frames before.
  void forget() noexcept TERRACUT_NONBLOCKING;

  /// Before the cut, for a frame whose sensor stands at `place`: finds what is remembered of its
  /// unknown cells, and makes those unknown that it says. `points`: of all cells.
  void look_back(const frame::Place& place, const frame::PointPlanes& points,
                 const stage::CellPlanes& planes,
                 std::span<min_cut::Seed> seeds) noexcept TERRACUT_NONBLOCKING;
  /// The prior of an unknown cell, scaled by kCapacityScale.
  [[nodiscard]] min_cut::LabelCosts operator()(std::uint32_t cell) const noexcept {
    const std::int32_t for_ground = prior_[cell];
    return for_ground > 0 ? min_cut::LabelCosts{0, for_ground}
                          : min_cut::LabelCosts{-for_ground, 0};
  }
  /// After the cut: remembers the frame that was looked back from. `lean(cell)`: what an unknown
  /// cell's own height says, [-1, 1], obstacle to ground.
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
  /// What a cell was by its frame alone.
  enum Own : std::uint8_t { kCertain, kOpen, kLow };

  void find_boxes(const frame::PointPlanes& points, const stage::CellPlanes& planes,
                  std::span<const min_cut::Seed> seeds) noexcept;
  [[nodiscard]] bool is_contradicted() const noexcept;
  void find_priors(const stage::CellPlanes& planes, std::span<min_cut::Seed> seeds) noexcept;
  [[nodiscard]] bool stands_beside_tall(std::uint32_t square) const noexcept;

  Config config_;
  StreetGrid grid_;
  std::uint32_t journey_ = 0;        ///< 0: nothing is remembered.
  std::span<std::uint32_t> box_;     ///< By cell.
  std::span<std::int16_t> prior_;    ///< By cell: for ground; against it where negative.
  std::span<std::uint8_t> own_;      ///< By cell: Own.
  std::span<std::uint8_t> is_tall_;  ///< By square: something tall stands there in this frame.
  std::uint32_t agreed_ = 0, contradicted_ = 0;
  stage::MemoryReport report_;
};

}  // namespace terracut::remembered
