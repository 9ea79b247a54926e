// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::cli {

/// Returns the screen of `terracut top`: the figures for people as lines that end with '\n'.
/// `now_ns` is the time of day, which shows if the process hangs. The output is printable ASCII
/// (and escape sequences of colours), whatever the snapshot's texts hold: another process wrote
/// them, and they go to a terminal.
[[nodiscard]] std::string dashboard(const status::MonitorSnapshot& figures, std::int64_t now_ns,
                                    const status::LineStyle& style);

/// Returns the final output of `terracut live`.
[[nodiscard]] std::string closing_lines(const status::MonitorSnapshot& figures);

/// Explains why a run has no frames, by what happened to its datagrams.
[[nodiscard]] std::string why_no_frames(const status::MonitorSnapshot& figures);

}  // namespace terracut::cli
