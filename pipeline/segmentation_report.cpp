// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/segmentation_report.hpp"

#include <algorithm>

namespace terracut::pipeline {

void SegmentationReport::count(std::span<const Label> labels) noexcept {
  returns = static_cast<std::uint32_t>(labels.size());
  ground = static_cast<std::uint32_t>(std::count(labels.begin(), labels.end(), Label::kGround));
  obstacles = returns - ground;
}

}  // namespace terracut::pipeline
