// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "calib/mount/mount_finder.hpp"
#include "recorded_frames.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// True if any figure of the mount is not stated and must be found.
[[nodiscard]] bool is_mount_open(const MountOptions& stated) noexcept;

/// The mount of a run.
struct MountChoice {
  MountOptions options;  ///< Stated figures, and the others as found or guessed.
  /// The result of the search; stated figures have no uncertainty. Empty if all were stated, or if
  /// the mount is a guess.
  std::optional<mount::FoundMount> found{};
  bool is_guess = false;  ///< The ground does not show the figures that were not stated.
};

/// Fills in figures that were not stated from those found.
[[nodiscard]] MountChoice filled_in(const MountOptions& stated, const mount::FoundMount& found);

/// Fills in figures that were not stated from `finder`, and prints them. If they are not certain
/// enough for labels: kMountNotFound, or, with MountOptions::may_guess, level at 1.73 m except for
/// certain figures, with a warning.
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 const mount::MountFinder& finder);
/// Chooses the mount with frames of the recording, if anything is not stated. Also errors of
/// each_frame().
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 RecordedFrames& frames);

/// Returns options that allow a guess, for a command whose labels nobody relies on, or that cannot
/// wait.
[[nodiscard]] MountOptions guessing(MountOptions stated);

}  // namespace terracut::cli
