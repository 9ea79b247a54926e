// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "label_changes.hpp"
#include "labelling.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Draws the frames whose labels differ between two labellings, from above, to
/// "DRIVE.NNNNNN.changes.png" in output.png (slashes of the drive's name become underscores).
/// Returns that became obstacle, became ground or changed otherwise have colours; unchanged returns
/// are dim. Reads points from the recordings again, as the job of `after` did, from a capture only
/// up to the frame. Fails with kInvalidArgument if `after` has no job, so that its recordings are
/// unknown, or if reading or writing fails.
[[nodiscard]] Status draw_changes(const Labelling& before, const Labelling& after,
                                  std::span<const FrameChange> frames, const OutputOptions& output);

}  // namespace terracut::cli
