// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "ros_types.h"

namespace terracut::dds {

/// Converts `time_ns`, nanoseconds since 1970; negative times are not allowed.
[[nodiscard]] constexpr builtin_interfaces_msg_dds__Time_ ros_time(std::int64_t time_ns) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {static_cast<std::int32_t>(time_ns / kSecond_ns),
          static_cast<std::uint32_t>(time_ns % kSecond_ns)};
}

/// Returns nanoseconds since 1970.
[[nodiscard]] constexpr std::int64_t ns_of(const builtin_interfaces_msg_dds__Time_& time) noexcept {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return time.sec * kSecond_ns + time.nanosec;
}

}  // namespace terracut::dds
