// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "firmware_io/can/can_frame.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::can {

/// The call of open_can_socket() that failed, and its errno.
struct CanSocketFailure {
  enum class Step : std::uint8_t { kSocket, kOptions, kFilter, kBind };
  Step step;
  int error_number;
};

/// The most ids the kernel takes for one socket.
inline constexpr std::size_t kMostCanFilters = 512;

/// A raw CAN socket on one interface that does not wait, takes FD frames, and hears these messages
/// alone (data frames of exactly these ids) and, if asked, all error frames. Without ids it hears
/// no message. Allocates nothing, so that an interface that came back can be opened any time.
/// At most kMostCanFilters ids.
[[nodiscard]] tl::expected<files::OwnedDescriptor, CanSocketFailure> open_can_socket(
    int interface_index, std::span<const CanId> ids, bool error_frames) noexcept;

/// The failure in words, with what mends it. kUnsupported: the kernel has no CAN; kNotFound: the
/// interface is gone or no CAN interface; kUnreadable: anything else.
[[nodiscard]] Error explain(const CanSocketFailure& failure, const std::string& interface);

}  // namespace terracut::can
