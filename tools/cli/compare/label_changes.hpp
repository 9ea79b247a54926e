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

/// Counts the returns whose labels differ.
struct ReturnChanges {
  std::uint64_t returns = 0;  ///< Returns compared.
  std::uint64_t to_obstacle = 0, to_ground = 0;
  std::uint64_t other = 0;  ///< Changes between kinds of ground, or from or to no label.

  [[nodiscard]] std::uint64_t changed() const noexcept { return to_obstacle + to_ground + other; }
  [[nodiscard]] double share() const noexcept {
    return returns == 0 ? 0 : static_cast<double>(changed()) / static_cast<double>(returns);
  }
  ReturnChanges& operator+=(const ReturnChanges& more) noexcept;
};

struct FrameChange {
  std::string drive, frame;  ///< Names; a frame's is like "000012".
  ReturnChanges changes;
};

struct DriveChange {
  std::string drive;
  std::uint64_t frames = 0, changed_frames = 0;
  ReturnChanges changes;
};

/// The differences between two labellings of recordings.
struct LabelChanges {
  std::uint64_t drives_before_alone = 0, drives_after_alone = 0;
  /// Frames that only one labelling has; its drive is in both.
  std::uint64_t frames_in_one_alone = 0;
  std::uint64_t frames_of_other_size = 0;  ///< Frames not compared: numbers of returns differ.
  std::uint64_t frames_by_sum = 0;         ///< Frames not read, as their sums agree.
  DriveChange all;
  std::vector<DriveChange> drives;  ///< Drives in both, largest changed share first.
  std::vector<FrameChange> most;    ///< Changed frames, largest share first.

  /// Returns several lines for people that list at most `shown` drives.
  [[nodiscard]] std::string text(std::size_t shown) const;
  [[nodiscard]] nlohmann::ordered_json json() const;
};

/// Compares labels: 40 and 49 count as ground, 99 as obstacle; the upper 16 bits are ignored. With
/// `trust_sums`, a file is not read if its sums in both SHA256SUMS and its sizes are equal and
/// neither copy was written since; otherwise all files are read, as a sum may be out of date.
/// `most` is the number of frames to name. Fails with the errors of reading label files, kNotFound
/// if no drive is in both, kNothingCameOut when stop_wanted().
[[nodiscard]] Expected<LabelChanges> compare_labels(const Labelling& before, const Labelling& after,
                                                    std::size_t most, bool trust_sums);

/// How the label of a return changed; kNone if it did not.
enum class LabelChange : std::uint8_t { kNone, kToObstacle, kToGround, kOther };
[[nodiscard]] bool is_obstacle_id(std::uint32_t label) noexcept;
[[nodiscard]] LabelChange change_between(std::uint32_t before, std::uint32_t after) noexcept;

}  // namespace terracut::cli
