// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "cell_grid.hpp"

namespace terracut::report {

/// Distances, of cell middles, that are told apart.
struct Annulus {
  std::string_view name;
  float from_m, to_m;
};
inline constexpr std::array kAnnuli{Annulus{"5–10 m", 5, 10}, Annulus{"10–20 m", 10, 20},
                                    Annulus{"20–40 m", 20, 40}, Annulus{"40–80 m", 40, 80}};

/// How many returns cells have: none, 1, 2–3, 4–7, ...; the last has all that is more.
inline constexpr std::array<std::string_view, 10> kPointBinNames{
    "0", "1", "2–3", "4–7", "8–15", "16–31", "32–63", "64–127", "128–255", "≥256"};
[[nodiscard]] std::size_t point_bin(std::uint32_t points) noexcept;

/// What returns are spread over cells, summed over cells and frames.
struct CellSums {
  std::uint64_t cells = 0;
  std::uint64_t empty = 0;
  double points = 0, points_squared = 0;
  std::uint64_t obstacles = 0;               ///< Returns.
  std::uint64_t obstacles_on_no_ground = 0;  ///< Those in a cell without any return of the ground.

  CellSums& operator+=(const CellSums& other) noexcept;
};

/// A grid's cells over any number of frames.
class CellTally {
 public:
  /// What a return is, for what is asked of cells.
  enum class Kind : std::uint8_t { kGround, kObstacle, kNeither };
  struct Sample {
    GroundPlace place;
    Kind kind = Kind::kNeither;
  };

  /// Adds a frame. Cells nearer or farther than all annuli do not count.
  void add(const CellGrid& grid, const std::vector<Sample>& samples);

  [[nodiscard]] const CellSums& annulus(std::size_t index) const { return annuli_[index]; }
  /// By point_bin(): cells that have as many points.
  [[nodiscard]] const std::array<std::uint64_t, kPointBinNames.size()>& histogram() const {
    return histogram_;
  }

 private:
  struct Cell {
    std::uint32_t points = 0, ground = 0, obstacles = 0;
  };

  std::array<CellSums, kAnnuli.size()> annuli_;
  std::array<std::uint64_t, kPointBinNames.size()> histogram_{};
  std::vector<Cell> cells_;  ///< Of one frame; kept for the next.
};

}  // namespace terracut::report
