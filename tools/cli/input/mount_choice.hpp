// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "calib/mount/mount_finder.hpp"
#include "recorded_frames.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Whether any figure of the mount is not stated, and so to be found.
[[nodiscard]] bool is_mount_open(const MountOptions& stated) noexcept;

/// The mount of a run.
struct MountChoice {
  MountOptions options;  ///< As stated, and what was open as it was found.
  /// What the ground showed of what was open; figures that were stated have no uncertainty.
  std::optional<mount::FoundMount> found;
};
/// "height 1.731 m (+-0.018), roll 0.00 deg (stated), pitch 0.31 deg (+-0.2), found in 10 frames";
/// empty where nothing was found.
[[nodiscard]] std::string text_of(const MountChoice& choice);

[[nodiscard]] MountChoice filled_in(const MountOptions& stated, const mount::FoundMount& found);

/// What `finder` found takes the place of what is open, or where it found nothing a level mount at
/// 1.73 m; either is said, and where the mount is uncertain that is.
[[nodiscard]] MountChoice choose_mount(const MountOptions& stated,
                                       const mount::MountFinder& finder);
/// The same by frames of the recording, where anything is open. The errors of each_frame().
[[nodiscard]] Expected<MountChoice> choose_mount(const MountOptions& stated,
                                                 RecordedFrames& frames);

/// Says it where a found mount is no more than a guess.
void warn_if_uncertain(const mount::FoundMount& found);

}  // namespace terracut::cli
