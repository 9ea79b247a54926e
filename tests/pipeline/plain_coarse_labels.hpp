// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <vector>

#include "calib/ring_profile.hpp"
#include "pipeline/profile.hpp"
#include "pipeline/range_image.hpp"
#include "pipeline/ring_grid.hpp"

namespace terracut::test {

/// What the elevation map and the adjacent points make of a turn, written a second time from their
/// rules (docs/method.md, the headers): the whole image at once, one cell after the other, in
/// double. Only the grid itself is taken over, which has tests of its own.
///
/// Where a rule hangs on less than float can tell, either answer is right; `may_be` and `must_be`
/// are a steep step with the slack given to it and taken from it.
struct PlainCoarseLabels {
  PlainCoarseLabels(const pipeline::SegmenterConfig& config, const calib::RingProfile& profile,
                    const pipeline::RingGrid& grid, const pipeline::RangeImage& image);

  // By cell of the image, padding included.
  std::vector<double> height_m;  ///< NaN without a return.
  std::vector<bool> may_be_steep, must_be_steep;
};

}  // namespace terracut::test
