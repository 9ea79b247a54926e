// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "label_changes.hpp"
#include "labelling.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Draws frames whose labels differ between two labellings, from above, to
/// "DRIVE.NNNNNN.changes.png" in output.png (slashes of the drive's name as underscores): returns
/// that became obstacle, returns that became ground, other changes, and the rest dim. Reads points
/// from the recordings again, as `after` did; from a capture all up to the frame. kInvalidArgument
/// if `after` has no job, so that its recordings are unknown; errors of the recordings and of
/// writing.
[[nodiscard]] Status draw_changes(const Labelling& before, const Labelling& after,
                                  std::span<const FrameChange> frames, const OutputOptions& output);

}  // namespace terracut::cli
