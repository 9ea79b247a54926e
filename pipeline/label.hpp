// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::pipeline {

/// What the pipeline says of a return or a cell.
enum class Label : std::uint8_t {
  kNone = 0,         ///< No return in this cell (never the label of a return).
  kGround = 1,       ///< Physical ground; road surface, where that is asked for (road_surface.hpp).
  kObstacle = 2,     ///< Everything else.
  kOtherGround = 3,  ///< Physical ground that is no road surface. Of returns only, not of cells.
};

/// Physical ground of either kind.
[[nodiscard]] constexpr bool is_ground(Label label) noexcept {
  return label == Label::kGround || label == Label::kOtherGround;
}

}  // namespace terracut::pipeline
