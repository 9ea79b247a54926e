// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string_view>

#include "pipeline/ros_messages/cdr_writer.hpp"
#include "pipeline/status/frame_record.hpp"

namespace terracut::ros_messages {

/// Returns the instant for which a frame's points are valid (CLOCK_REALTIME): the instant to which
/// they were deskewed or, if they were not, the stamp of the first packet.
[[nodiscard]] constexpr std::int64_t stamp_ns_of(const status::FrameRecord& record) noexcept {
  const frame::DeskewInfo& deskew = record.info.deskew;
  return deskew.state == frame::DeskewState::kDone ? deskew.reference_ns
                                                   : record.info.first_packet_ns;
}

/// Adds a builtin_interfaces/Time.
inline void add_time(CdrWriter& to, std::int64_t time_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t rest_ns = time_ns % kSecond_ns;
  const bool is_before_1970 = rest_ns < 0;  // nanoseconds count forward even before 1970
  to.add(static_cast<std::int32_t>(time_ns / kSecond_ns - (is_before_1970 ? 1 : 0)));
  to.add(static_cast<std::uint32_t>(rest_ns + (is_before_1970 ? kSecond_ns : 0)));
}

/// Adds a std_msgs/Header.
inline void add_header(CdrWriter& to, std::int64_t stamp_ns, std::string_view frame_id) {
  add_time(to, stamp_ns);
  to.add(frame_id);
}

}  // namespace terracut::ros_messages
