// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "pipeline/status/figure.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/mount_figures.hpp"

namespace terracut::status {

/// Returns all figures of a live run, from one table (figures.cpp): they are shown by `terracut
/// top`, /metrics, --json and the final summary, and checked on a status page. Adding a figure
/// means adding a row. They refer to `snapshot`, which may have any content.
[[nodiscard]] std::vector<Figure> figures_of(const MonitorSnapshot& snapshot);

/// Return the parts that runs over files have as well.
[[nodiscard]] std::vector<Figure> figures_of(const MountFigures& mount);
[[nodiscard]] std::vector<Figure> figures_of(const frame::BlindAzimuths& blind);

/// True if a process can have published these figures: times and counts are consistent, so that it
/// is safe to calculate with them. A status page is a file that others can write to and may have
/// any content.
[[nodiscard]] bool are_possible(const MonitorSnapshot& snapshot);

/// Explains for people a contradicted mount and how to mend it; empty if there is none.
[[nodiscard]] std::string contradiction_text(const MountFigures& mount);
/// Explains for people a guessed mount; empty if it is none.
[[nodiscard]] std::string guess_text(const MountFigures& mount);

}  // namespace terracut::status
