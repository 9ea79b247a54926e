// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

/// How the dashboard of `terracut top` is drawn.
struct DashboardStyle {
  bool colours = false;  ///< ANSI escape sequences, for terminals.
  int columns = 80;      ///< Width of the terminal; the bars take what is left.
};

/// The figures for people, lines ended by '\n'. `now_ns`: time of day, against which ages are told.
/// Only printable ASCII comes out (and the escape sequences of colours), whatever the texts of the
/// snapshot hold: it was written by another process and goes to a terminal.
[[nodiscard]] std::string dashboard(const rt::MonitorSnapshot& figures, std::int64_t now_ns,
                                    const DashboardStyle& style);

}  // namespace terracut::cli
