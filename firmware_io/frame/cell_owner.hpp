// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::frame {

/// Which of several returns in one cell owns the cell, that is, represents it in the segmentation.
/// The other returns are labelled as well (return_labels.hpp).
enum class CellOwner : std::uint8_t {
  kFirstArrived,  ///< The return that arrived first.
  kStrongest,     ///< The return of the highest intensity.
  kNearest,   ///< The return at the smallest horizontal distance: the first surface a beam meets.
  kFarthest,  ///< The return at the greatest horizontal distance: the last surface.
};

}  // namespace terracut::frame
