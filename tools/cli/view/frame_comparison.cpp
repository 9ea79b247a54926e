// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_comparison.hpp"

#include <cstddef>

namespace terracut::cli {

static_assert(static_cast<int>(quality::TruthClass::kIgnored) == 0 &&
                  static_cast<int>(quality::TruthClass::kKeyObstacle) == 3 &&
                  static_cast<int>(frame::Label::kNone) == 0 &&
                  static_cast<int>(frame::Label::kOtherGround) == 3,
              "the page (compared.js) reads these two bits each");

void compare(std::span<const frame::Label> labels, std::span<const frame::Label> beside,
             std::span<const std::uint32_t> truth, FrameComparison& comparison) {
  const bool has_truth = truth.size() == labels.size();
  const bool has_beside = beside.size() == labels.size();
  comparison.quality.reset();
  comparison.quality_beside.reset();
  comparison.differing = 0;
  comparison.of_returns.assign(has_truth || has_beside ? labels.size() : 0, 0);
  if (has_truth) {
    comparison.quality = quality::measure(labels, truth);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      comparison.of_returns[i] = static_cast<std::uint8_t>(quality::truth_class(truth[i]));
    }
  }
  if (!has_beside) return;
  if (has_truth) comparison.quality_beside = quality::measure(beside, truth);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    comparison.of_returns[i] |= static_cast<std::uint8_t>(static_cast<unsigned>(beside[i]) << 2U);
    comparison.differing += labels[i] != beside[i] ? 1 : 0;
  }
}

}  // namespace terracut::cli
