// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/segmentation_report.hpp"

#include "rt/vector_clones.hpp"

namespace terracut::stage {
namespace {

/// Counts like std::count(), whose wide result prevents vectorisation.
TERRACUT_VECTOR_CLONES std::uint32_t count_of(const frame::Label* labels, std::size_t size,
                                              frame::Label wanted) noexcept {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < size; ++i) count += labels[i] == wanted ? 1U : 0U;
  return count;
}

TERRACUT_VECTOR_CLONES std::uint32_t count_less(const float* height_m, std::size_t size,
                                                float limit_m) noexcept {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < size; ++i) count += height_m[i] < limit_m ? 1U : 0U;
  return count;
}

}  // namespace

std::uint32_t count_below(std::span<const float> height_m, float limit_m) noexcept {
  return count_less(height_m.data(), height_m.size(), limit_m);
}

void SegmentationReport::count(std::span<const frame::Label> labels) noexcept {
  returns = static_cast<std::uint32_t>(labels.size());
  other_ground = count_of(labels.data(), labels.size(), frame::Label::kOtherGround);
  ground = count_of(labels.data(), labels.size(), frame::Label::kGround) + other_ground;
  obstacles = returns - ground;
}

}  // namespace terracut::stage
