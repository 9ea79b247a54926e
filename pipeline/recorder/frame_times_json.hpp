// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pipeline/recorder/dump_record.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::recorder {

/// The text that lies beside a dump's capture: what the capture holds, and for each frame of those
/// seconds when it was where and what it cost. Its numbers are those of status::FrameRecord under
/// the same names; a frame of the capture is found by its last_packet_ns, the stamp of a datagram,
/// and is "whole" when the capture begins before its first. Frames outside the capture are left
/// out. `stages`: lower_snake_case names of the first stages of FrameRecord::stage_cpu_ns; stages
/// without a name are left out.
[[nodiscard]] std::string frame_times_json(const DumpReport& report, DumpReason reason,
                                           std::span<const status::FrameRecord> frames,
                                           std::span<const std::string_view> stages);

}  // namespace terracut::recorder
