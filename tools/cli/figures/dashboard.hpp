// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::cli {

/// What `terracut top` shows: the figures for people, lines ended by '\n'. `now_ns`: time of day,
/// by which it is seen that a process hangs. Only printable ASCII comes out (and the escape
/// sequences of colours), whatever the texts of the snapshot hold: it was written by another
/// process and goes to a terminal.
[[nodiscard]] std::string dashboard(const status::MonitorSnapshot& figures, std::int64_t now_ns,
                                    const status::LineStyle& style);

/// What `terracut live` prints at its end.
[[nodiscard]] std::string closing_lines(const status::MonitorSnapshot& figures);

/// Of a run out of which no frame came: what became of its datagrams instead.
[[nodiscard]] std::string why_no_frames(const status::MonitorSnapshot& figures);

}  // namespace terracut::cli
