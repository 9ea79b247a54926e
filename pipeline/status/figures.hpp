// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "pipeline/status/figure.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "pipeline/visibility/sight_figures.hpp"

namespace terracut::status {

/// Returns all figures of a live run, from one table (figures.cpp). `terracut top`, /metrics,
/// --json and the final summary show them, and a status page is checked by them. So a new figure
/// needs only a new row in that table. The figures refer to `snapshot`, which may have any content.
[[nodiscard]] std::vector<Figure> figures_of(const MonitorSnapshot& snapshot);

/// Each of these returns a group of figures that runs over files have, too.
[[nodiscard]] std::vector<Figure> figures_of(const MountFigures& mount);
[[nodiscard]] std::vector<Figure> figures_of(const frame::BlindAzimuths& blind);
[[nodiscard]] std::vector<Figure> figures_of(const visibility::SightFigures& sight);

/// True if a process can have published these figures: times and counts are consistent, so that
/// calculating with them is safe. A status page is a file that others can write to, so it may have
/// any content.
[[nodiscard]] bool are_possible(const MonitorSnapshot& snapshot);

/// Explains to people how the mount is contradicted and what to do; empty if it is not.
[[nodiscard]] std::string contradiction_text(const MountFigures& mount);
/// Explains to people that the mount is guessed; empty if it is not.
[[nodiscard]] std::string guess_text(const MountFigures& mount);

}  // namespace terracut::status
