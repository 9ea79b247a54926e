// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cell_tally.hpp"
#include "chosen_frames.hpp"
#include "frame_reader.hpp"

namespace terracut::report {

/// A division of the ground that is compared: real frames and the flat world over its cells.
struct CountedGrid {
  std::string name;  ///< "squares of 0.5 m"
  std::function<std::unique_ptr<CellGrid>(const mount::RingProfile&, frame::ImageShape)> make;
  CellTally recorded, flat;
};

/// Squares of three sizes, and the rings of the `paper` profile.
[[nodiscard]] std::vector<CountedGrid> grids_to_count();

/// How many frames went into it, and why others did not.
struct CountedFrames {
  std::size_t counted = 0;
  std::vector<std::string> faults;
};
/// Counts the returns of `frames` over the cells of every grid, and the flat world of every
/// sequence once.
[[nodiscard]] CountedFrames count_cells(const std::vector<ChosenFrame>& frames, FrameReader& reader,
                                        std::vector<CountedGrid>& grids,
                                        const std::function<void()>& on_frame);

/// What was counted, as sums from which shares, means and variations follow:
///   counted, faults[]                of frames
///   distances[], returns_in_a_cell[] names of the annuli and of the histogram's bins
///   grids[]  name, recorded[] and flat[] by distance, histogram[] of the recorded frames
[[nodiscard]] Json cells_json(const std::vector<CountedGrid>& grids, const CountedFrames& frames);

}  // namespace terracut::report
