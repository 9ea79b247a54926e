// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "pipeline/recorder/dump_record.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::recorder {

/// Returns the JSON that is stored beside a capture: facts about the capture and, for each of its
/// frames, cost and times. Numbers are those of status::FrameRecord, under the same names;
/// last_packet_ns is the stamp of a datagram in the capture. A frame is "whole" if the capture
/// begins before the frame's first packet. Frames outside the capture are left out. `stages` names
/// the first stages of FrameRecord::stage_cpu_ns in lower_snake_case; other stages are left out.
[[nodiscard]] std::string frame_times_json(const DumpReport& report, DumpReason reason,
                                           std::span<const status::FrameRecord> frames,
                                           std::span<const std::string_view> stages);

}  // namespace terracut::recorder
