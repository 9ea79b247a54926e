// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

/// The stages of the segmentation in order. The first three are the rows of the paper's Table III:
/// each can be the last one that runs.
enum class Stage : std::uint8_t {
  kElevationMap,    ///< The ring-based elevation map.
  kAdjacentPoints,  ///< Adds spatiotemporal adjacent points.
  kSeeds,           ///< Adds confidence seeds of the Markov random field (MRF).
  kMinCut,          ///< Adds energy and min-cut: the whole method.
  kLabels,          ///< Labels the returns from the cells, and finds the road surface.
  kCount,
};
inline constexpr int kStages = static_cast<int>(Stage::kCount);

/// The names of the stages in reports, in lower_snake_case.
inline constexpr std::array<std::string_view, kStages> kStageNames{
    "elevation_map", "adjacent_points", "seeds", "min_cut", "labels"};
[[nodiscard]] constexpr std::string_view to_string(Stage stage) noexcept {
  return stage < Stage::kCount ? kStageNames[static_cast<std::size_t>(stage)] : "unknown";
}

/// Notified when a stage ends. The pipeline has no clock of its own; an observer may bring one.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  /// Called on the labelling thread when it starts or resumes work on a frame.
  virtual void resumed() noexcept TERRACUT_NONBLOCKING {}
  /// Called on the labelling thread right after `stage` or a part of `stage`. Both functions must
  /// be real-time safe.
  virtual void stage_done(Stage stage) noexcept TERRACUT_NONBLOCKING = 0;
};

/// Notifies an observer, if there is one.
inline void resumed(StageObserver* observer) noexcept TERRACUT_NONBLOCKING {
  if (observer != nullptr) observer->resumed();
}
inline void done(Stage stage, StageObserver* observer) noexcept TERRACUT_NONBLOCKING {
  if (observer != nullptr) observer->stage_done(stage);
}

}  // namespace terracut::stage
