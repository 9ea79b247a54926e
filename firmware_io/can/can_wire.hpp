// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>

#include "firmware_io/can/can_frame.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::can {

/// Frames as the Linux kernel hands them over and captures hold them: 4 bytes of id and flags, the
/// length, FD flags, 2 reserved bytes, then the data. Sizes as in <linux/can.h>.
inline constexpr std::size_t kClassicWireBytes = 16;
inline constexpr std::size_t kFdWireBytes = 72;
inline constexpr std::size_t kWireHeaderBytes = 8;

/// Byte order of the id: the machine's own from a socket and in "cooked" captures (link type 113),
/// big endian in captures of a CAN interface (link type 227).
enum class CanIdOrder : std::uint8_t { kNative, kBigEndian };

/// Why bytes are no frame of ours.
enum class CanReject : std::uint8_t {
  kXl,         ///< CAN XL.
  kTruncated,  ///< Fewer bytes than its length says, or than the header.
  kLength,     ///< A length that such a frame cannot have.
  kId,         ///< A number of more than 11 bits in the 11-bit format.
};

/// The frame in `bytes`; its stamp is left 0. A frame is FD where its flag says so, or where there
/// are as many bytes as only FD frames have: older kernels and captures do not set the flag.
[[nodiscard]] tl::expected<CanFrame, CanReject> parse_can_wire(
    std::span<const std::uint8_t> bytes, CanIdOrder order) noexcept TERRACUT_NONBLOCKING;

/// The frame as a socket takes it, native order; returns how much of `bytes` it is: 16 or 72.
[[nodiscard]] std::size_t write_can_wire(const CanFrame& frame,
                                         std::span<std::uint8_t, kFdWireBytes> bytes) noexcept
    TERRACUT_NONBLOCKING;

}  // namespace terracut::can
