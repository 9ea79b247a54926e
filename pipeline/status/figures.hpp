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

/// All figures of a live run, in one table (figures.cpp): what `terracut top`, /metrics, --json and
/// the summary at the end show, and what is checked of a status page. A figure is added by a row.
/// They refer to `snapshot`, in which there may be anything.
[[nodiscard]] std::vector<Figure> figures_of(const MonitorSnapshot& snapshot);

/// Parts of it, which runs over files have as well.
[[nodiscard]] std::vector<Figure> figures_of(const MountFigures& mount);
[[nodiscard]] std::vector<Figure> figures_of(const frame::BlindAzimuths& blind);

/// Figures that a process can have published: times and counts fit together, so that everything
/// that shows them may calculate with them. A status page is a file that others can write to, and
/// what is in it may be anything.
[[nodiscard]] bool are_possible(const MonitorSnapshot& snapshot);

/// For people, with what mends it; empty where nothing is contradicted.
[[nodiscard]] std::string contradiction_text(const MountFigures& mount);
/// For people; empty where the mount is no guess.
[[nodiscard]] std::string guess_text(const MountFigures& mount);

}  // namespace terracut::status
