// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::cli {

/// Returns the path of frames through the threads in Chrome's trace event format, which Perfetto's
/// UI and chrome://tracing open: one track each for receive, segment and publish, slices for frames
/// and their stages, an instant event for each missed deadline. Times are microseconds since the
/// earliest stamp, whose time of day is otherData.origin_ns.
///
/// Stages are measured in processor time, so their slices follow one another from the start of the
/// frame, each as wide as that time; where the frame's slice shows no stage, its thread was off the
/// core. Around the seam two frames are open at once, so a frame's slice begins at its first
/// packet, but not before the previous frame was handed over.
///
/// `figures` gives the stages' names and the deadline; `frames` are in the order in which they were
/// judged.
[[nodiscard]] nlohmann::ordered_json chrome_trace(const status::MonitorSnapshot& figures,
                                                  std::span<const status::FrameRecord> frames);

}  // namespace terracut::cli
