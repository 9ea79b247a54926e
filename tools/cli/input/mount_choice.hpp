// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "calib/mount/mount_finder.hpp"
#include "recorded_frames.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// True if a figure of the mount is not stated, so that it must be found.
[[nodiscard]] bool is_mount_open(const MountOptions& stated) noexcept;

/// The mount of a run.
struct MountChoice {
  MountOptions options;  ///< All figures: stated, found or guessed.
  /// The result of the search, in which stated figures have no uncertainty. Empty if all figures
  /// were stated or the mount is a guess.
  std::optional<mount::FoundMount> found{};
  bool is_guess = false;  ///< True if the ground did not show the figures that were not stated.
};

/// Returns the stated figures, completed by those of the mount found.
[[nodiscard]] MountChoice filled_in(const MountOptions& stated, const mount::FoundMount& found);

/// Takes figures that were not stated from `finder`, and prints them. If they are too uncertain for
/// labels, fails with kMountNotFound. With MountOptions::may_guess it warns instead, and the
/// figures that are too uncertain become those of a level mount at 1.73 m.
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 const mount::MountFinder& finder);
/// Finds the figures that are not stated from frames of the recording. Fails as the function above
/// does, and with the errors of each_frame().
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 RecordedFrames& frames);

/// Returns `stated` with guessing allowed, for commands whose labels nobody relies on, or that
/// cannot wait.
[[nodiscard]] MountOptions guessing(MountOptions stated);

}  // namespace terracut::cli
