// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "labelling.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Returns of which two labelings say different things.
struct ReturnChanges {
  std::uint64_t returns = 0;  ///< Compared.
  std::uint64_t to_obstacle = 0, to_ground = 0;
  std::uint64_t other = 0;  ///< Between kinds of ground, or to or from no label.

  [[nodiscard]] std::uint64_t changed() const noexcept { return to_obstacle + to_ground + other; }
  [[nodiscard]] double share() const noexcept {
    return returns == 0 ? 0 : static_cast<double>(changed()) / static_cast<double>(returns);
  }
  ReturnChanges& operator+=(const ReturnChanges& more) noexcept;
};

struct FrameChange {
  std::string drive, frame;  ///< "000012"
  ReturnChanges changes;
};

struct DriveChange {
  std::string drive;
  std::uint64_t frames = 0, changed_frames = 0;
  ReturnChanges changes;
};

/// How one labelling of recordings differs from another.
struct LabelChanges {
  std::uint64_t drives_before_alone = 0, drives_after_alone = 0;
  std::uint64_t frames_in_one_alone = 0;   ///< Of drives in both.
  std::uint64_t frames_of_other_size = 0;  ///< As many returns in neither: not compared.
  std::uint64_t frames_by_sum = 0;         ///< Not read, for both SHA256SUMS say the same.
  DriveChange all;
  std::vector<DriveChange> drives;  ///< In both; by share, the most changed first.
  std::vector<FrameChange> most;  ///< Frames, by share, the most changed first; only changed ones.

  /// For people, several lines; `shown` drives at most.
  [[nodiscard]] std::string text(std::size_t shown) const;
  [[nodiscard]] nlohmann::ordered_json json() const;
};

/// Ground: 40 and 49; obstacle: 99; the upper 16 bits do not count. `trust_sums`: files that have
/// the same sum in both SHA256SUMS, are as long, and were not written to since then, are not read.
/// Else all are, for a sum says what a file once was. `most`: how many frames to name. The errors
/// of the label files;
/// kNotFound where there is no drive in both; kNothingCameOut when stop_wanted().
[[nodiscard]] Expected<LabelChanges> compare_labels(const Labelling& before, const Labelling& after,
                                                    std::size_t most, bool trust_sums);

/// What became of a return; kNone: the same as before.
enum class LabelChange : std::uint8_t { kNone, kToObstacle, kToGround, kOther };
[[nodiscard]] bool is_obstacle_id(std::uint32_t label) noexcept;
[[nodiscard]] LabelChange change_between(std::uint32_t before, std::uint32_t after) noexcept;

}  // namespace terracut::cli
