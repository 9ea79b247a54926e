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

/// Which system call in open_can_socket() failed, and its errno.
struct CanSocketFailure {
  enum class Step : std::uint8_t { kSocket, kOptions, kFilter, kBind };
  Step step;
  int error_number;
};

/// The most filters that the kernel takes for one socket.
inline constexpr std::size_t kMostCanFilters = 512;

/// Opens a non-blocking raw CAN socket on one interface. It takes FD frames and receives only data
/// frames with exactly the given ids (none if there are no ids; at most kMostCanFilters) and, if
/// asked, all error frames. Allocates nothing, so that an interface that came back can be opened at
/// any time.
[[nodiscard]] tl::expected<files::OwnedDescriptor, CanSocketFailure> open_can_socket(
    int interface_index, std::span<const CanId> ids, bool error_frames) noexcept;

/// Returns the failure as an error, with how to mend it: kUnsupported if the kernel has no CAN,
/// kNotFound if the interface is gone or is no CAN interface, else kUnreadable.
[[nodiscard]] Error explain(const CanSocketFailure& failure, const std::string& interface);

}  // namespace terracut::can
