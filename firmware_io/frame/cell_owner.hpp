// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::frame {

/// Which of several returns in one cell owns it, that is stands for it in the segmentation. The
/// others are labelled, too (return_labels.hpp).
enum class CellOwner : std::uint8_t {
  kFirstArrived,  ///< No preference.
  kStrongest,     ///< The highest intensity.
  kNearest,       ///< The smallest horizontal distance: the first surface a beam meets.
  kFarthest,      ///< The last one.
};

}  // namespace terracut::frame
