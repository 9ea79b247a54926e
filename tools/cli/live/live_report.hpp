// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

/// What `terracut live` prints at its end: frames, misses, latency, losses, and what
/// there was on CAN buses.
[[nodiscard]] std::string live_report(const rt::MonitorSnapshot& figures);

/// Of a run out of which no frame came: what became of its datagrams instead.
[[nodiscard]] std::string why_no_frames(const rt::MonitorSnapshot& figures);

}  // namespace terracut::cli
