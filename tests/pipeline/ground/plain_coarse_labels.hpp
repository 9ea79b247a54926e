// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "pipeline/ground/profile.hpp"

namespace terracut::test {

/// What the elevation map and the adjacent points make of a frame, written a second time from their
/// rules (docs/reference/method.md, the headers): the whole image at once, one cell after the
/// other, in double. Only the grid itself is taken over, which has tests of its own.
///
/// Where a rule hangs on less than float can tell, either answer is right; `may_be` and `must_be`
/// are a steep step with the slack given to it and taken from it.
struct PlainCoarseLabels {
  PlainCoarseLabels(const ground::SegmenterConfig& config, const mount::RingProfile& profile,
                    const elevation::RingGrid& grid, const frame::RangeImage& image);

  // By cell of the image, padding included.
  std::vector<double> height_m;      ///< NaN without a return.
  std::vector<double> stands_out_m;  ///< Above what its row shows of the ground; NaN: nothing.
  std::vector<bool> may_be_steep, must_be_steep;
};

}  // namespace terracut::test
