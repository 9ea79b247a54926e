// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/min_cut/grid_problem.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::random_field {

/// The rows of the range image that the Markov random field (MRF) decides.
enum class CutRows : std::uint8_t {
  kAuto,  ///< kAll for images of up to 64 rows, kGround for denser ones.
  kAll,   ///< Every row.
  /// The rows whose beam meets the mount's ground plane within the profile's range limit (70 of 128
  /// rows of an RS-Ruby128 in the paper). Higher rows keep the label of earlier stages.
  kGround,
};

/// Stage 3a: chooses the returns that initialise the MRF as "object" and "background"; other
/// returns stay unknown (paper, section III-D). Obstacles of earlier stages are trusted: the random
/// field decides where evidence is weak, and never removes an obstacle that was seen. Ground is
/// trusted if the share of ground in a window around it exceeds k.
class ConfidenceSeeds {
 public:
  struct Config {
    float ground_share = 0.7F;  ///< Share k of ground among the window's returns, [0, 1].
    int window_rows = 2;        ///< Row steps the window extends up and down, [0, 8].
    int window_columns = 3;     ///< Columns the window extends to each side, [0, 16].
    CutRows rows = CutRows::kAuto;
  };

  /// `profile` must have shape.rows rings. `row_step_deg` is the least elevation of a row step
  /// (RowSteps), [0, 5].
  ConfidenceSeeds(const Config& config, float row_step_deg, const mount::RingProfile& profile,
                  frame::ImageShape shape, memory::FixedMemory& memory);

  /// Chooses the seeds of these columns from the labels in them and reach() columns to either side.
  /// Real-time safe.
  void select(const stage::CellPlanes& planes,
              frame::ColumnRange columns) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] int reach() const noexcept { return config_.window_columns; }

  [[nodiscard]] std::span<const min_cut::Seed> seeds() const noexcept { return seeds_; }
  /// Returns the seeds; the cut writes its decisions about unknown cells into them.
  [[nodiscard]] std::span<min_cut::Seed> mutable_seeds() noexcept { return seeds_; }
  /// Returns how many rows may hold unknown returns: rows 0 to cut_rows() - 1.
  [[nodiscard]] int cut_rows() const noexcept { return cut_rows_; }

 private:
  void start_counting(frame::ColumnRange columns) noexcept;
  void count_in_columns(const stage::CellPlanes& planes, int row,
                        frame::ColumnRange columns) noexcept;
  void find_trusted_ground(std::span<std::uint8_t> trusted) noexcept;

  Config config_;
  frame::ImageShape shape_;
  int cut_rows_;
  std::span<std::int32_t> window_begin_, window_end_;  // by row: rows [begin, end) of its window
  int counted_begin_ = 0, counted_end_ = 0;            // rows included in the sums below
  std::span<min_cut::Seed> seeds_;
  // Sums over the rows of a row's windows, by column from reach() before the first one selected.
  std::span<std::uint8_t> ground_in_column_;
  std::span<std::uint8_t> returns_in_column_;
  // Sums over whole windows; stored as bytes if there is share_65536_.
  std::span<std::uint16_t> sums_;
  int most_in_window_ = 0;                  // most returns in a window
  int share_65536_ = -1;                    // ground_share in 65536ths; -1: windows are too large
  std::span<std::uint8_t> trusted_ground_;  // of the row being judged
};

}  // namespace terracut::random_field
