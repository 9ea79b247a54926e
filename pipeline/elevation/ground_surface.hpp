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
/// Departs from the paper, which always takes the lowest return of a cell as ground: a car that
/// hides the ground becomes ground. Here each sector is traced from the vehicle outwards; the
/// lowest return of a cell is ground only if a passable slope leads to it from the last ground.
/// Lost ground is found again where the lowest returns form a passable path of some metres (a bank
/// behind a ditch, a hillside behind a hedge). Cells without ground of their own are interpolated
/// from the nearest sectors with ground. Where the ground rises from sector to sector (a bank seen
/// along its length), it also rises within a sector.
class GroundSurface {
 public:
  static constexpr float kEmpty = 1e9F;

  /// The lowest return of a grid cell, and the range it lies at: on a slope it is at the cell's
  /// near or far end, not in its middle. Half a band of 2 m at a slope of 40 % is 0.4 m of height.
  struct LowestReturn {
    float height_m = kEmpty;    ///< kEmpty where the cell had no return.
    float range_m = 0;          ///< Horizontal.
    float highest_m = -kEmpty;  ///< Highest return of the cell.
  };
  struct Config {
    float step_up_m = 0.04F;        ///< Rise accepted at zero distance (noise, bumps).
    float slope_tolerance = 0.25F;  ///< Further rise or fall accepted per metre traced.
    float step_up_limit_m = 0.34F;  ///< A higher rise is never accepted, at any distance.
    float start_slope = 0.18F;  ///< Height per metre above the mount's plane, beyond `step_up_m`,
                                ///< at which the first ground may lie: returns nearer than the
                                ///< first ring's ground are mostly of a car's flank.
    float foot_rise_m = 0.18F;  ///< The limit where something tall stands.
    float tall_m = 0.5F;        ///< Tall: this much above the cell's lowest return.
    float extra_fall = 0.30F;   ///< Further fall accepted per metre traced (ground may drop away).
    float slope_gain = 0.20F;   ///< Share of a new step in the running slope, (0, 1].
    float max_slope = 0.55F;    ///< Largest running slope, rise over run.
    float slope_memory_m = 2.0F;     ///< How far the running slope is continued without ground.
    float first_slope_run_m = 0.4F;  ///< Shorter steps count as this long for the slope.
    float regain_length_m = 3.5F;    ///< Passable metres after which lost ground is found again.
    float regain_slope = 0.55F;      ///< Steepest start of that path from the last ground.
    float regain_gap_m = 1e9F;       ///< Longest step on that path.
    float unconnected_gap_m = 3.5F;  ///< Longest step on a path that starts steeper, as over a
                                     ///< car's roof: there it ends, and the bank behind begins
                                     ///< another.
    float regain_width_m = 4.0F;     ///< Least width of the strip found again.
    int interpolate_sectors = 14;    ///< Sectors to each side for interpolating a cell.
    float traced_weight = 0.30F;     ///< Weight of the prediction against a neighbour's 1/distance.
    float max_cross_slope = 0.5F;  ///< Steepest ground across a sector, rise over width, if nothing
                                   ///< tall (`tall_m`) stands there; 0: level across.
  };

  /// Ground heights above the mount's plane at a sector's first and last edge.
  struct EdgeHeights {
    float first_m = 0, last_m = 0;

    [[nodiscard]] float lower_m() const noexcept { return first_m < last_m ? first_m : last_m; }
    bool operator==(const EdgeHeights&) const = default;
  };

  GroundSurface(const Config& config, const RingGrid& grid, memory::FixedMemory& memory);

  // Order of calls for a frame, which may still be arriving: reset(), trace() sectors as they
  // become known, finalize() those whose surface is needed early, finally finalize_rest().

  /// Begins a frame with no sector traced. Real-time safe, like all functions here.
  void reset() noexcept TERRACUT_NONBLOCKING;
  /// Traces these sectors, whose lowest returns are known.
  void trace(const RingGrid& grid, RingGrid::Sectors sectors,
             std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;
  /// Estimates the surface in sectors that have been traced. Sectors not traced yet contribute
  /// nothing.
  void finalize(const RingGrid& grid, RingGrid::Sectors sectors,
                std::span<const LowestReturn> lowest) noexcept TERRACUT_NONBLOCKING;
  /// Estimates the surface of the whole frame once all sectors have been traced. Sets
  /// `is_current[s]` to 0 if this changes the surface that finalize() found for sector s.
  void finalize_rest(const RingGrid& grid, std::span<const LowestReturn> lowest,
                     std::span<std::uint8_t> is_current) noexcept TERRACUT_NONBLOCKING;
  /// Returns how many sectors to each side a sector's surface depends on (more only beside a strip
  /// that may be too narrow to be ground).
  [[nodiscard]] int reach() const noexcept { return std::max(interpolate_sectors_, 1); }

  /// Returns the ground at the middle of each grid cell's band; valid in cells with a return and in
  /// the bands next to them. One extra element at the end, so that every cell has a successor.
  [[nodiscard]] std::span<const EdgeHeights> heights() const noexcept { return heights_; }

 private:
  enum Origin : std::uint8_t {
    kPredicted,  // the cell had no return, or none on the ground
    kMeasured,   // the cell's own lowest return is the ground
    kRegained,   // as kMeasured, after the trace had lost the ground
  };

  /// The state of a trace: its last step and the running slope.
  struct Trace {
    float height_m = 0;  // starts on the mount's plane, under the sensor
    float range_m = 0;
    float slope = 0;

    [[nodiscard]] float predict_m(float to_range_m, const Config& config) const noexcept;
    [[nodiscard]] bool reaches(float to_range_m, float to_height_m,
                               const Config& config) const noexcept;
    /// Steps there. Returns the slope of the step, limited to max_slope up or down.
    float step(float to_range_m, float to_height_m, const Config& config) noexcept;
  };

  template <class T>
  [[nodiscard]] static std::span<T> of_sector(std::span<T> cells, const RingGrid& grid,
                                              int sector) noexcept {
    return cells.subspan(grid.cell(sector, 0), static_cast<std::size_t>(grid.bands()));
  }
  /// True if a trace may go on to the lowest return of a cell.
  [[nodiscard]] bool leads_to(const Trace& ground, const LowestReturn& here) const noexcept;
  /// True if the first ground of a trace may be so high.
  [[nodiscard]] bool may_start_at(const LowestReturn& here) const noexcept {
    return here.height_m < config_.step_up_m + config_.start_slope * here.range_m;
  }
  void trace_outward(const RingGrid& grid, int sector,
                     std::span<const LowestReturn> lowest) noexcept;
  /// Traces from `band` to the end of the sector, or until ground is lost that can be found again
  /// nearer than where the trace would continue. Returns the last band with ground, or -1.
  int trace_on(const RingGrid& grid, int sector, int band, Origin origin, Trace& ground,
               std::span<const LowestReturn> lowest) noexcept;
  /// Where ground begins again, and its slope there.
  struct Detour {
    int band = -1;  // -1: nowhere
    float slope = 0;
  };
  /// Returns the first band between `lost_band` and `end_band` that is passable from the lost
  /// ground and continues passably for `regain_length_m`.
  [[nodiscard]] Detour find_ground_again(const RingGrid& grid, int sector, int lost_band,
                                         int end_band, const Trace& ground,
                                         std::span<const LowestReturn> lowest) const noexcept;
  /// Finds which ground of a sector its neighbours may use: all of it, except ground found again on
  /// a strip too narrow to be ground (a row of car roofs, for example).
  void find_donors(const RingGrid& grid, int sector) noexcept;
  [[nodiscard]] bool lies_on_wide_strip(const RingGrid& grid, int sector, int band) const noexcept;
  /// Estimates a sector's surface from the ground in it and its neighbours. True if that changed
  /// it.
  bool estimate(const RingGrid& grid, int sector, std::span<const LowestReturn> lowest) noexcept;
  [[nodiscard]] float interpolated_m(const RingGrid& grid, int sector, int band) const noexcept;

  Config config_;
  int interpolate_sectors_;  // at most half the circle
  std::span<float> traced_m_;
  std::span<EdgeHeights> heights_;
  std::span<Origin> found_;               // by the trace; kPredicted where not traced
  std::span<Origin> origin_;              // found_ without narrow strips
  std::span<std::uint8_t> has_regained_;  // by sector: found_ has kRegained
  std::span<std::uint8_t> is_open_;       // by sector: its surface must be estimated again
  std::span<std::int32_t> wide_from_;     // by band: least sectors of a wide strip
  std::span<float> max_rise_m_;           // by band, across a sector
};

}  // namespace terracut::elevation
