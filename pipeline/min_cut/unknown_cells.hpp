// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Cell indices in fixed memory, large enough for every cell of the image.
struct CellList {
  std::span<std::uint32_t> storage;
  std::uint32_t size = 0;

  void push_back(std::uint32_t cell) noexcept { storage[size++] = cell; }
  [[nodiscard]] std::span<const std::uint32_t> view() const noexcept { return storage.first(size); }
};

/// Finds the cells that become nodes: the unknown ones, at most `max_unknown`. Where there are
/// more, the nearest are kept, by 0.25 m steps of ground range and in row-major order within the
/// last step.
class UnknownCells {
 public:
  UnknownCells(const frame::ImageShape& shape, std::uint32_t max_unknown,
               memory::FixedMemory& memory);

  /// Appends the cells beyond the cap to `dropped`; `labels` are the coarse labels they are pinned
  /// to. Real-time safe.
  void find(const GridProblem& problem, std::span<const frame::Label> labels,
            CellList& dropped) noexcept TERRACUT_NONBLOCKING;

  /// Kept cells in row-major order; node i of the graph is cells()[i].
  [[nodiscard]] std::span<const std::uint32_t> cells() const noexcept { return found_.view(); }

  /// There were more than max_unknown.
  [[nodiscard]] bool has_pinned() const noexcept { return has_pinned_; }
  /// Node of an unknown cell, or a kPinned... value when it is beyond the cap. Of a cell whose seed
  /// is not kUnknown: any number.
  [[nodiscard]] std::uint32_t node_of(std::uint32_t cell) const noexcept {
    return node_of_cell_[cell];
  }
  static constexpr std::uint32_t kPinnedGround = 0xFFFFFFFE;
  static constexpr std::uint32_t kPinnedObstacle = 0xFFFFFFFF;

 private:
  static constexpr std::size_t kRangeSteps = 1024;
  static constexpr float kStepsPerMetre = 4.0F;

  void keep_nearest(const GridProblem& problem, std::span<const frame::Label> labels,
                    CellList& dropped) noexcept;
  [[nodiscard]] static std::size_t range_step(float ground_range_m) noexcept;

  std::uint32_t max_unknown_;
  CellList found_;
  bool has_pinned_ = false;
  std::span<std::uint32_t> node_of_cell_, histogram_;
};

}  // namespace terracut::min_cut
