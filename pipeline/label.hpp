// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::pipeline {

/// What the pipeline says of a return or a cell.
enum class Label : std::uint8_t {
  kNone = 0,      ///< No return in this cell (never the label of a return).
  kGround = 1,    ///< Physical ground.
  kObstacle = 2,  ///< Everything else.
};

}  // namespace terracut::pipeline
