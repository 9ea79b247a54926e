// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/segmentation_report.hpp"

#include <algorithm>

namespace terracut::pipeline {

void SegmentationReport::count(std::span<const Label> labels) noexcept {
  returns = static_cast<std::uint32_t>(labels.size());
  const auto of = [&](Label label) {
    return static_cast<std::uint32_t>(std::count(labels.begin(), labels.end(), label));
  };
  other_ground = of(Label::kOtherGround);
  ground = of(Label::kGround) + other_ground;
  obstacles = returns - ground;
}

}  // namespace terracut::pipeline
