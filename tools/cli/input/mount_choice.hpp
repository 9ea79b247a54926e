// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "calib/mount/mount_finder.hpp"
#include "recorded_frames.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Whether any figure of the mount is not stated, and so to be found.
[[nodiscard]] bool is_mount_open(const MountOptions& stated) noexcept;

/// The mount of a run.
struct MountChoice {
  MountOptions options;  ///< As stated, and what was open as it was found or guessed.
  /// What the ground showed of what was open; figures that were stated have no uncertainty. None
  /// where all was stated, or where it is a guess.
  std::optional<mount::FoundMount> found{};
  bool is_guess = false;  ///< The ground does not show what was open.
};

/// What was found takes the place of what is open.
[[nodiscard]] MountChoice filled_in(const MountOptions& stated, const mount::FoundMount& found);

/// What `finder` found takes the place of what is open, and is said. Where it found nothing that
/// labels can be made by: kMountNotFound, or, with MountOptions::may_guess, level at 1.73 m but for
/// what was found well enough, with a warning.
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 const mount::MountFinder& finder);
/// The same by frames of the recording, where anything is open. Also the errors of each_frame().
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 RecordedFrames& frames);

/// Of a command whose work is not labels that others rely on, or that cannot wait for them: it goes
/// on with a guess.
[[nodiscard]] MountOptions guessing(MountOptions stated);

}  // namespace terracut::cli
