// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pipeline/stage/stage.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// The processor time that a thread spent on one frame by stage, in nanoseconds.
struct StageTimes {
  std::array<std::int64_t, kStages> stage_ns{};

  StageTimes& operator+=(const StageTimes& more) noexcept {
    for (std::size_t i = 0; i < stage_ns.size(); ++i) stage_ns[i] += more.stage_ns[i];
    return *this;
  }
  [[nodiscard]] std::int64_t sum_ns() const noexcept TERRACUT_NONBLOCKING {
    std::int64_t sum = 0;
    for (const std::int64_t one_ns : stage_ns) sum += one_ns;
    return sum;
  }
};

}  // namespace terracut::stage
