// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::elevation {

/// The grid of the ring-based elevation map (paper, section III-B): bands of range follow the rings
/// on the ground, sectors of azimuth are equal, so that every cell expects the same number of
/// ground returns at any distance.
///
/// Band b covers a span of horizontal range. Boundaries lie midway between the mean ground
/// distances of neighbouring lasers; bands narrower than `min_band_m` are merged, wider ones than
/// `max_band_m` are cut, and beyond the last ring that reaches the ground bands of `max_band_m` go
/// on to `range_limit_m`. Everything farther away belongs to the last band.
class RingGrid {
 public:
  /// The size of a cell.
  struct Config {
    float min_band_m = 0.4F;
    float max_band_m = 2.0F;
    float range_limit_m = 100.0F;  ///< (0, 250]
    int columns_per_sector = 10;   ///< Image columns a sector covers; [1, 64].
  };
  static constexpr float kStepsPerMetre = 32.0F;  ///< Resolution of boundaries: 3 cm.
  /// Rings that lie farther apart than this on level ground leave ground unseen between them.
  static constexpr float kFarApart_m = 1.0F;
  static constexpr int kMaxBands = 250;  ///< Largest number that fits the 8-bit band numbers.

  /// Where a range lies between the middles of two adjacent bands, for linear interpolation.
  struct BandMix {
    std::int32_t inner = 0;
    float outer_share = 0;  ///< Weight of the outer band, [0, 1]; 0 before the first middle.
  };
  /// The BandMix of each range step as arrays, for vector code, and the number of the last step, to
  /// which step_of() limits ranges.
  struct BandMixes {
    const BandMix* of_step;
    float last_step;
  };

  RingGrid(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
           memory::FixedMemory& memory);

  [[nodiscard]] int bands() const noexcept { return bands_; }
  [[nodiscard]] int sectors() const noexcept { return sectors_; }
  [[nodiscard]] std::size_t cells() const noexcept {
    return static_cast<std::size_t>(bands_) * static_cast<std::size_t>(sectors_);
  }
  /// Returns the cell's index; cells are stored sector by sector, each from the vehicle outwards.
  [[nodiscard]] std::size_t cell(int sector, int band) const noexcept {
    return static_cast<std::size_t>(sector) * static_cast<std::size_t>(bands_) +
           static_cast<std::size_t>(band);
  }
  /// Returns the mean range of a band, metres.
  [[nodiscard]] float center_m(int band) const noexcept {
    return center_m_[static_cast<std::size_t>(band)];
  }

  /// Returns how much of a step into this band is ground that no ring shows: how far apart the
  /// rings on either side lie on level ground, less kFarApart_m; 0 where they lie nearer, and
  /// within the first ring.
  [[nodiscard]] float unseen_m(int band) const noexcept {
    return unseen_m_[static_cast<std::size_t>(band)];
  }
  /// Returns the depth of the deepest band beyond the first ring, metres.
  [[nodiscard]] float deepest_band_m() const noexcept { return deepest_band_m_; }

  /// Returns the band of a horizontal range; the last band for NaN. Real-time safe.
  [[nodiscard]] int band_of(float ground_range_m) const noexcept {
    return band_of_step_[step_of(ground_range_m)];
  }
  /// Returns the band of a range, the next band, and where the range lies between them.
  [[nodiscard]] BandMix mix_of(float ground_range_m) const noexcept {
    return mixes_[step_of(ground_range_m)];
  }
  [[nodiscard]] BandMixes mixes() const noexcept { return {mixes_.data(), last_step_}; }
  /// Converts ranges to steps of 1 / kStepsPerMetre for band_of_step(), many at once.
  void find_steps(std::span<const float> ground_range_m,
                  std::span<std::uint16_t> steps) const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int band_of_step(std::uint16_t step) const noexcept { return band_of_step_[step]; }
  /// Returns the sector of an image column.
  [[nodiscard]] int sector_of(int column) const noexcept {
    return sector_of_column_[static_cast<std::size_t>(column)];
  }
  /// Returns, for each image column, the index of the first cell of the column's sector.
  [[nodiscard]] std::span<const std::int32_t> first_cell_of_column() const noexcept {
    return first_cell_of_column_;
  }
  /// Returns where the middle of each image column lies between the edges of its sector, (0, 1).
  [[nodiscard]] std::span<const float> share_across() const noexcept { return share_across_; }
  /// Adjacent sectors [begin, end), which do not cross the seam of the circle.
  struct Sectors {
    int begin, end;
  };
  /// Maps a sector number up to one revolution below 0, or any number above the last, to a valid
  /// number.
  [[nodiscard]] int wrapped(int sector) const noexcept {
    if (sector < 0) return sector + sectors_;
    while (sector >= sectors_) sector -= sectors_;
    return sector;
  }
  /// Returns the image columns that `sectors` cover.
  [[nodiscard]] frame::ColumnRange columns_of(Sectors sectors) const noexcept {
    return {first_column_[static_cast<std::size_t>(sectors.begin)],
            first_column_[static_cast<std::size_t>(sectors.end)]};
  }

 private:
  [[nodiscard]] std::size_t step_of(float ground_range_m) const noexcept {
    const float step = ground_range_m * kStepsPerMetre;
    return step < last_step_ ? static_cast<std::size_t>(step) : band_of_step_.size() - 1;
  }

  int bands_ = 0;
  int sectors_ = 0;
  float last_step_ = 0;
  float deepest_band_m_ = 0;
  std::span<float> center_m_;
  std::span<float> unseen_m_;  // by band
  std::span<std::uint8_t> band_of_step_;
  std::span<BandMix> mixes_;  // by step
  std::span<std::uint16_t> sector_of_column_;
  std::span<std::int32_t> first_cell_of_column_;
  std::span<float> share_across_;          // by column
  std::span<std::uint16_t> first_column_;  // first column by sector, and the end of the last sector
};

}  // namespace terracut::elevation
