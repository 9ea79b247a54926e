// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "pipeline/elevation/ring_grid.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// The local ground surface over a ring grid, from the lowest return of every grid cell.
///
/// This departs from the paper, which always takes the lowest return of a cell as ground, even the
/// return from a car that hides the ground. Here each sector is traced from the vehicle outwards;
/// the lowest return of a cell is ground only if a passable step leads to it from the last ground.
/// Steps may rise more where the rings lie far apart, for between them the ground is not seen.
/// Lost ground is found again where the lowest returns form a passable path of some metres (a bank
/// behind a ditch, a hillside behind a hedge). A cell without ground is interpolated from the
/// nearest sectors with ground. Where the ground rises from sector to sector (a bank seen along its
/// length), it also rises within a sector.
class GroundSurface {
 public:
  static constexpr float kEmpty = 1e9F;

  /// The lowest return of a grid cell, with its range: on a slope it is at an end of the cell, not
  /// in the middle. Half a band of 2 m at a slope of 40 % is 0.4 m of height.
  struct LowestReturn {
    float height_m = kEmpty;    ///< Height of the lowest return; kEmpty if the cell has no return.
    float range_m = 0;          ///< Horizontal range of the lowest return.
    float highest_m = -kEmpty;  ///< Height of the cell's highest return.
    std::int32_t is_no_ground = 0;  ///< 1 if its row shows that the lowest return is no ground.
  };
  struct Config {
    float step_up_m = 0.04F;        ///< Rise that is accepted even without distance (noise, bumps).
    float slope_tolerance = 0.3F;   ///< Further rise or fall accepted per metre of a step ...
    float step_up_limit_m = 0.35F;  ///< ... up to this rise ...
    float far_slope = 0.06F;        ///< ... and this much more per metre where rings lie far apart.
    float extra_fall = 0.10F;       ///< Further fall accepted per metre (ground may drop away).
    float start_slope = 0.18F;      ///< First ground may be this high above the mount's plane, per
                                ///< metre of range and beyond `step_up_m`; nearer than the first
                                ///< ring's ground, most returns come from a car's flank.
    float tall_m = 0.5F;           ///< A return so far above its cell's lowest return marks a tall
                                   ///< thing; no step into such a cell may rise by an obstacle's
                                   ///< height.
    float max_slope = 0.5F;        ///< Steepest ground, as rise over run, in any direction.
    float regain_length_m = 4.0F;  ///< Length of passable path on which lost ground is found again,
                                   ///< least width of such ground, and longest step of a path that
                                   ///< no passable step leads to.
    int interpolate_sectors = 14;  ///< Sectors behind from which a cell is interpolated ...
    int sectors_ahead = 5;         ///< ... and sectors ahead, which are waited for.
  };

  /// Heights of the ground above the mount's plane at the first and the last edge of a sector.
  struct EdgeHeights {
    float first_m = 0, last_m = 0;

    [[nodiscard]] float lower_m() const noexcept { return first_m < last_m ? first_m : last_m; }
    bool operator==(const EdgeHeights&) const = default;
  };

  GroundSurface(const Config& config, float obstacle_height_m, const RingGrid& grid,
                memory::FixedMemory& memory);

  // Sectors are numbered on without end: beyond the last sector come those of the circle's
  // beginning. Each of the next three functions takes every sector of a circle once, in order, as
  // soon as the function before it has taken the sectors named there. All are real-time safe.

  /// Traces a sector; its lowest returns must be known.
  void trace(const RingGrid& grid, int sector,
             std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;
  /// Finds which ground of a sector its neighbours may use: all ground, except a strip found again
  /// that is too narrow to be ground (a row of car roofs, for example). Sectors from kStripBehind
  /// behind it to kStripAhead ahead of it must be traced.
  void find_donors(const RingGrid& grid, int sector) noexcept TERRACUT_NONBLOCKING;
  /// Estimates the surface of a sector from the ground in the sector and in its neighbours. Sectors
  /// from behind() behind it to ahead() ahead of it must have their donors.
  void estimate(const RingGrid& grid, int sector,
                std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;

  static constexpr int kStripBehind = 14, kStripAhead = 4;
  [[nodiscard]] int behind() const noexcept { return std::max(behind_, 1); }
  [[nodiscard]] int ahead() const noexcept { return std::max(ahead_, 1); }

  /// Returns the ground at the middle of each grid cell's band; valid in cells with a return and in
  /// the bands next to such cells. One extra element at the end gives every cell a successor.
  [[nodiscard]] std::span<const EdgeHeights> heights() const noexcept { return heights_; }

 private:
  enum Origin : std::uint8_t {
    kPredicted,  // the cell had no return, or none on the ground
    kMeasured,   // the cell's own lowest return is the ground
    kRegained,   // as kMeasured, but ground was lost before this cell and found again
  };

  /// The last ground of a trace, which starts on the mount's plane, under the sensor.
  struct Ground {
    float height_m = 0;
    float range_m = 0;
    float slope = 0;  // of the ground there, where it was found again
  };

  template <class T>
  [[nodiscard]] static std::span<T> of_sector(std::span<T> cells, const RingGrid& grid,
                                              int sector) noexcept {
    return cells.subspan(grid.cell(sector, 0), static_cast<std::size_t>(grid.bands()));
  }
  /// True if the trace may continue from `ground` to the lowest return of a cell in `band`.
  [[nodiscard]] bool leads_to(const RingGrid& grid, const Ground& ground, int band,
                              const LowestReturn& here) const noexcept;
  /// True if the first ground of a trace may be as high as `here`.
  [[nodiscard]] bool may_start_at(const LowestReturn& here) const noexcept {
    return here.height_m < config_.step_up_m + config_.start_slope * here.range_m;
  }
  /// True if ground that is not seen may lead from one return to the other: no steeper than
  /// max_slope as far as bands are deep, and no steeper than far_slope beyond.
  [[nodiscard]] bool is_passable(const LowestReturn& from, const LowestReturn& to) const noexcept;
  /// Returns the slope of a step, limited to +-max_slope.
  [[nodiscard]] float slope_of(float rise_m, float run_m) const noexcept;
  /// Traces from `band` to the end of the sector, or to where ground is lost that can be found
  /// again nearer than the trace would continue. Returns the last band with ground, or -1.
  int trace_on(const RingGrid& grid, int sector, int band, Origin origin, Ground& ground,
               std::span<const LowestReturn> lowest) noexcept;
  /// The band where lost ground begins again, and the slope of the ground there.
  struct Detour {
    int band = -1;  // -1: nowhere
    float slope = 0;
  };
  /// Returns the first band between `lost_band` and `end_band` that is passable from the lost
  /// ground and continues passably for `regain_length_m`.
  [[nodiscard]] Detour find_ground_again(const RingGrid& grid, int sector, int lost_band,
                                         int end_band, const Ground& ground,
                                         std::span<const LowestReturn> lowest) const noexcept;
  [[nodiscard]] bool lies_on_wide_strip(const RingGrid& grid, int sector, int band) const noexcept;
  /// Replaces the heights of a sector's bands that are missing by those of other sectors.
  void interpolate(const RingGrid& grid, int sector, std::span<const std::uint8_t> is_missing,
                   std::span<float> height_m) const noexcept;

  Config config_;
  float foot_rise_m_;   // largest rise of a step to the foot of something tall
  float deep_m_;        // depth of the deepest bands
  int behind_, ahead_;  // sectors to either side that a cell is interpolated from
  std::span<float> traced_m_;
  std::span<EdgeHeights> heights_;
  std::span<Origin> found_;   // origin found by the trace; kPredicted where nothing is traced
  std::span<Origin> origin_;  // found_ without the narrow strips
  std::span<std::uint8_t> has_regained_;  // by sector: 1 if found_ has kRegained
  std::span<std::int32_t> wide_from_;     // by band: number of sectors from which a strip is wide
  std::span<float> max_rise_m_;           // by band: largest rise across a sector
};

}  // namespace terracut::elevation
