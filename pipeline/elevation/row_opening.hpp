// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// Tells what stands out of a row on both sides, for rows whose next ring lies far away on the
/// ground: of a car at 30 m or of a person lying at 20 m such a sensor sees one row, too few to
/// find a step, but the row comes up from the ground and goes down to it again.
///
/// The lowest heights of the row's sectors are opened (Matheron 1967): the opening at a sector is
/// the highest of the lowest heights of all windows around it. A window is `window_m` wide along
/// the ring, and heights may rise by `slope` along it, as banks and roads do. What lies more than
/// an obstacle's height above the opening stands out. Of a window at most kMostBehind sectors lie
/// behind a sector and kMostAhead ahead of it.
class RowOpening {
 public:
  struct Config {
    float window_m = 5.0F;  ///< Widest thing that stands out, along the ring.
  };

  /// `slope`: rise over run along a ring that does not stand out. The rows are those of `profile`,
  /// of which none need be there.
  RowOpening(const Config& config, float slope, const RingGrid& grid,
             const mount::RingProfile& profile, memory::FixedMemory& memory);

  static constexpr int kMostBehind = 8, kMostAhead = 4;
  /// Returns how many sectors behind and ahead must be taken before a sector is opened.
  [[nodiscard]] int behind() const noexcept { return behind_; }
  [[nodiscard]] int ahead() const noexcept { return ahead_; }

  // Order of calls: take() for each row with sectors that became known; open() for a sector when
  // all from behind() before it to ahead() after it are taken. All functions below are real-time
  // safe.

  /// True if the row is opened, so that it is known what stands out of it.
  [[nodiscard]] bool has(int row) const noexcept {
    return static_cast<std::size_t>(row) < slots_.size() &&
           slots_[static_cast<std::size_t>(row)] >= 0;
  }
  /// Takes a row's heights and ranges in the columns of `sectors`; both start at the first of these
  /// columns. NaN: no return.
  void take(int row, RingGrid::Sectors sectors, const float* z_m, const float* range_m,
            const RingGrid& grid) noexcept TERRACUT_NONBLOCKING;
  void open(int sector) noexcept TERRACUT_NONBLOCKING;
  /// Returns the opening of a row that has() one, above which things stand out; a height above all
  /// returns if the row has none in the sector.
  [[nodiscard]] float opening_m(int row, int sector) const noexcept {
    return opening_m_[place(slots_[static_cast<std::size_t>(row)], sector)];
  }

 private:
  static constexpr float kEmpty = 1e9F;

  [[nodiscard]] std::size_t place(int slot, int sector) const noexcept {
    return static_cast<std::size_t>(sector * used_ + slot);
  }
  /// Marks the slots that have lower heights in their window on one side, behind (-1) or ahead (1).
  void find_lower(int sector, int side, int most, std::span<std::int32_t> is_lower) const noexcept;
  [[nodiscard]] float opened(int slot, int sector) const noexcept;

  int sectors_;
  float sector_rad_;
  float window_m_, slope_;
  int behind_ = 0, ahead_ = 0;
  int used_ = 0;                   // number of rows with a slot
  std::span<std::int16_t> slots_;  // by row: its number among the rows that are opened, or -1
  std::span<float> lowest_m_;      // by sector and slot; kEmpty if there is no return
  std::span<float> range_m_;       // of the lowest return
  std::span<float> opening_m_;     // by sector and slot
  // By slot, of the sector at work:
  std::span<float> sector_m_;                                 // how wide a sector is
  std::span<float> window_sectors_;                           // how many of them are a window
  std::span<std::int32_t> is_lower_behind_, is_lower_ahead_;  // whether there are lower heights
};

}  // namespace terracut::elevation
