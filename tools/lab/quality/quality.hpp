// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"

namespace terracut::quality {

/// The role of a class, by its SemanticKITTI id or another dataset's, in the measures (peers.md
/// conventions; docs/reference/method.md).
enum class TruthClass : std::uint8_t {
  kIgnored,  ///< Unlabelled or outlier (0, 1): counts nowhere.
  kGround,   ///< 40 road, 44 parking, 48 sidewalk, 49 other ground, 60 lane marking, 72 terrain.
  kOrdinaryObstacle,  ///< Everything else.
  kKeyObstacle,       ///< Motor vehicles, bicycles, persons, moving or not.
};

/// Returns the class of a label file's entry; the instance in its upper 16 bits is ignored.
[[nodiscard]] TruthClass truth_class(std::uint32_t semantic_kitti_id) noexcept;

/// Counts of returns by truth and label, and the paper's measures. Add frames, then read.
struct Quality {
  std::uint64_t ground_as_ground = 0;
  std::uint64_t ground_as_obstacle = 0;
  std::uint64_t obstacle_as_ground = 0;
  std::uint64_t obstacle_as_obstacle = 0;
  std::uint64_t key_as_ground = 0;    ///< Also counted in obstacle_as_ground.
  std::uint64_t key_as_obstacle = 0;  ///< Also counted in obstacle_as_obstacle.

  void add(frame::Label label, std::uint32_t semantic_kitti_id) noexcept;
  void add(TruthClass truth, std::uint64_t as_ground, std::uint64_t as_obstacle) noexcept;
  Quality& operator+=(const Quality& other) noexcept;

  [[nodiscard]] double iou_ground() const noexcept;  ///< IoU_g, Eq. 16; [0, 1]; 1 without ground.
  [[nodiscard]] double recall_key_obstacles() const noexcept;  ///< Recall_o, Eq. 17; 1 without any.
  [[nodiscard]] double precision_ground() const noexcept;
  [[nodiscard]] double recall_ground() const noexcept;
};

/// Returns the quality of one frame: labels[i] against truth[i], over the shorter of the two.
[[nodiscard]] Quality measure(std::span<const frame::Label> labels,
                              std::span<const std::uint32_t> truth) noexcept;

}  // namespace terracut::quality
