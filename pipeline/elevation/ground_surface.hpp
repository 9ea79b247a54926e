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
/// Departs from the paper, which takes the lowest return of a cell for the ground whatever it is:
/// there a car that hides the ground becomes ground. Here each sector is traced from the vehicle
/// outwards; the lowest return of a cell is ground only if a passable slope leads to it from the
/// ground before. Ground that was lost is found again where the lowest returns form a passable way
/// of some metres among themselves (a bank behind a ditch, a hillside behind a hedge). Cells
/// without ground of their own take an interpolation of the nearest sectors that have it. Where the
/// ground rises from sector to sector, a bank seen along its length, it rises across them, too.
class GroundSurface {
 public:
  static constexpr float kEmpty = 1e9F;

  /// The lowest return of a grid cell. On a slope it lies at the cell's near or far end, not in its
  /// middle: half a band of 2 m at a slope of 40 % is 0.4 m of height.
  struct LowestReturn {
    float height_m = kEmpty;    ///< kEmpty where the cell had no return.
    float range_m = 0;          ///< Horizontal.
    float highest_m = -kEmpty;  ///< Of all returns of the cell.
  };
  struct Config {
    float step_up_m = 0.04F;        ///< Rise accepted at no distance at all (noise, bumps).
    float slope_tolerance = 0.25F;  ///< Further rise or fall accepted per metre traced.
    float step_up_limit_m = 0.34F;  ///< A higher rise is never accepted, at whatever distance.
    float start_slope = 0.18F;  ///< Beside `step_up_m`, how much higher per metre than the mount's
                                ///< plane the first ground may lie: what is seen nearer than the
                                ///< first ring's ground is a car's flank as a rule.
    float foot_rise_m = 0.18F;  ///< A higher rise is not accepted where something tall stands ...
    float tall_m = 0.5F;        ///< ... which is this much higher than the cell's lowest return.
    float extra_fall = 0.30F;   ///< Further fall accepted per metre traced (ground may drop away).
    float slope_gain = 0.20F;   ///< Share of a new step in the running slope, (0, 1].
    float max_slope = 0.55F;    ///< Largest running slope, rise over run.
    float slope_memory_m = 2.0F;  ///< How far the running slope is carried on over missing ground.
    float first_slope_run_m =
        0.4F;  ///< A shorter step than this counts as this long for the slope.
    float regain_length_m =
        3.5F;  ///< Lost ground is found again after so many metres of passable steps ...
    float regain_slope = 0.55F;  ///< ... that begin no steeper than this from the last ground ...
    float regain_gap_m = 1e9F;   ///< ... without a longer step among them ...
    float unconnected_gap_m = 3.5F;  ///< ... (a way that began steeper, like that over a parked
                                     ///< car's roof, ends at a longer step, and the bank behind it
                                     ///< begins another) ...
    float regain_width_m = 4.0F;     ///< ... on a strip at least so wide.
    int interpolate_sectors =
        14;  ///< How many sectors to each side a cell may be interpolated from.
    float traced_weight =
        0.30F;  ///< Weight of the traced prediction against a neighbour's 1/distance.
    float max_cross_slope = 0.5F;  ///< Steepest ground across a sector, rise over width, where
                                   ///< nothing tall (`tall_m`) stands; 0: one height for all of it.
  };

  /// Ground heights above the mount's plane where a sector's first column begins and where its last
  /// one ends.
  struct EdgeHeights {
    float first_m = 0, last_m = 0;

    [[nodiscard]] float lower_m() const noexcept { return first_m < last_m ? first_m : last_m; }
    bool operator==(const EdgeHeights&) const = default;
  };

  GroundSurface(const Config& config, const RingGrid& grid, memory::FixedMemory& memory);

  // For a frame, also while it arrives: reset(), then trace() sectors as they become known,
  // finalize() those whose surface is wanted already, and at last finalize_rest().

  /// A new frame: no sector has been traced. Real-time safe, as all of this.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// The lowest returns of these sectors are known.
  void trace(const RingGrid& grid, RingGrid::Sectors sectors,
             std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;
  /// Estimates the surface in sectors that have been traced. A neighbour that has not been walked
  /// yet gives no ground.
  void finalize(const RingGrid& grid, RingGrid::Sectors sectors,
                std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;
  /// Estimates the surface of the whole frame once all sectors have been traced. `is_current[s]`
  /// becomes 0 where this changed the surface that finalize() had found for sector s.
  void finalize_rest(const RingGrid& grid, std::span<const LowestReturn> lowest,
                     std::span<std::uint8_t> is_current) noexcept TERRACUT_NONBLOCKING;
  /// The surface of a sector depends on this many sectors to each side (on more of them only
  /// beside a strip that may be too narrow to be ground).
  [[nodiscard]] int reach() const noexcept { return std::max(interpolate_sectors_, 1); }

  /// The ground in the middle of each grid cell's band; meaningful in cells that had a return and
  /// in the bands next to them. One more at the end, of no cell, so that there is a next one
  /// everywhere.
  [[nodiscard]] std::span<const EdgeHeights> heights() const noexcept { return heights_; }

 private:
  enum Origin : std::uint8_t {
    kPredicted,  // the cell had no return, or none on the ground
    kMeasured,   // the cell's own lowest return is the ground
    kRegained,   // the same, but the trace lost the ground on its way here
  };

  /// Where a trace stands: its last step and the slope it has been going at.
  struct Trace {
    float height_m = 0;  // at first on the mount's plane, under the sensor
    float range_m = 0;
    float slope = 0;

    [[nodiscard]] float predict_m(float to_range_m, const Config& config) const noexcept;
    [[nodiscard]] bool reaches(float to_range_m, float to_height_m,
                               const Config& config) const noexcept;
    /// Goes there; the slope of the step, at most max_slope up or down.
    float step(float to_range_m, float to_height_m, const Config& config) noexcept;
  };

  template <class T>
  [[nodiscard]] static std::span<T> of_sector(std::span<T> cells, const RingGrid& grid,
                                              int sector) noexcept {
    return cells.subspan(grid.cell(sector, 0), static_cast<std::size_t>(grid.bands()));
  }
  /// Whether a trace may go on to the lowest return of a cell.
  [[nodiscard]] bool leads_to(const Trace& ground, const LowestReturn& here) const noexcept;
  /// Whether the first ground that a trace meets may be so high.
  [[nodiscard]] bool may_start_at(const LowestReturn& here) const noexcept {
    return here.height_m < config_.step_up_m + config_.start_slope * here.range_m;
  }
  void trace_outward(const RingGrid& grid, int sector,
                     std::span<const LowestReturn> lowest) noexcept;
  /// Traces from `band` to the end of the sector, or until ground is lost that can be found again
  /// on the way to where it would go on; returns the last band that was ground, or -1.
  int trace_on(const RingGrid& grid, int sector, int band, Origin origin, Trace& ground,
               std::span<const LowestReturn> lowest) noexcept;
  /// Where ground begins again, and the slope it goes on at.
  struct Detour {
    int band = -1;  // -1: nowhere
    float slope = 0;
  };
  /// The first band of those after `lost_band` and before `end_band` that is passable from where
  /// the ground was lost and leads on passably for `regain_length_m`.
  [[nodiscard]] Detour find_ground_again(const RingGrid& grid, int sector, int lost_band,
                                         int end_band, const Trace& ground,
                                         std::span<const LowestReturn> lowest) const noexcept;
  /// Finds which ground of a sector its neighbours may use: all that was found in it, except ground
  /// found again on a strip too narrow to be ground (a row of car roofs, for example).
  void find_donors(const RingGrid& grid, int sector) noexcept;
  [[nodiscard]] bool lies_on_wide_strip(const RingGrid& grid, int sector, int band) const noexcept;
  /// The surface of a sector from what was found in it and in its neighbours; true where that
  /// changed it.
  bool estimate(const RingGrid& grid, int sector, std::span<const LowestReturn> lowest) noexcept;
  [[nodiscard]] float interpolated_m(const RingGrid& grid, int sector, int band) const noexcept;

  Config config_;
  int interpolate_sectors_;  // at most half of the circle
  std::span<float> traced_m_;
  std::span<EdgeHeights> heights_;
  std::span<Origin> found_;               // by the trace; kPredicted in sectors not traced
  std::span<Origin> origin_;              // without narrow strips
  std::span<std::uint8_t> has_regained_;  // of each sector, anything of found_
  std::span<std::uint8_t> is_open_;       // of each sector: its surface is not that of origin_ yet
  std::span<std::int32_t> wide_from_;     // of each band: a strip of so many sectors is wide enough
  std::span<float> max_rise_m_;           // of each band, across a sector
};

}  // namespace terracut::elevation
