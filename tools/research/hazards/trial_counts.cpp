// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "trial_counts.hpp"

#include "labelled_frame.hpp"

namespace terracut::hazards {

SeenHazard seen_hazard(const MovedReturns& moved, std::span<const frame::Label> labels) noexcept {
  SeenHazard seen;
  for (const MovedReturn& one : moved) {
    if (!one.counts) continue;
    ++seen.returns;
    seen.as_obstacle += frame::is_ground(labels[one.index]) ? 0 : 1;
  }
  return seen;
}

Elsewhere elsewhere(const LabelledFrame& frame, const MovedReturns& moved,
                    std::span<const frame::Label> before,
                    std::span<const frame::Label> after) noexcept {
  const auto add = [](quality::Quality& quality, datasets::Role role, frame::Label label) {
    const bool as_ground = frame::is_ground(label);
    quality.add(role, as_ground ? 1 : 0, as_ground ? 0 : 1);
  };
  Elsewhere result;
  auto next = moved.begin();
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    if (next != moved.end() && next->index == i) {
      ++next;
      continue;
    }
    add(result.before, frame.role[i], before[i]);
    add(result.after, frame.role[i], after[i]);
  }
  return result;
}

}  // namespace terracut::hazards
