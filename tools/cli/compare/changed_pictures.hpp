// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "label_changes.hpp"
#include "labelling.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Draws frames of which two labelings say different things, from above, "DRIVE.NNNNNN.changes.png"
/// in output.png, with slashes of the drive's name as underscores: returns that were ground and are
/// obstacle, those that were obstacle and are ground, others that changed, and the rest dim. Points
/// are read from the recordings again, as `after` has read them; of captures everything up to the
/// frame. kInvalidArgument where `after` is of no job, so that its recordings are not known; errors
/// of the recordings and of writing.
[[nodiscard]] Status draw_changes(const Labelling& before, const Labelling& after,
                                  std::span<const FrameChange> frames, const OutputOptions& output);

}  // namespace terracut::cli
