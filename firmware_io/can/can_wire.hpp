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

/// The layout of a CAN frame as the Linux kernel and captures store it: 4 bytes of id and flags,
/// the length, FD flags, 2 reserved bytes, then the data. Sizes as in <linux/can.h>.
inline constexpr std::size_t kClassicWireBytes = 16;
inline constexpr std::size_t kFdWireBytes = 72;
inline constexpr std::size_t kWireHeaderBytes = 8;

/// Byte order of the id: the machine's own on a socket and in "cooked" captures (link type 113),
/// big-endian in captures of one CAN interface (link type 227).
enum class CanIdOrder : std::uint8_t { kNative, kBigEndian };

/// Why bytes were not accepted as a frame.
enum class CanReject : std::uint8_t {
  kXl,         ///< A CAN XL frame.
  kTruncated,  ///< There are fewer bytes than the header or its length field needs.
  kLength,     ///< The length is one that this kind of frame cannot have.
  kId,         ///< An 11-bit id has a number of more than 11 bits.
};

/// Parses the frame in `bytes`; the stamp stays 0. The frame is FD if its flag says so or if it is
/// as long as only FD frames are: older kernels and captures do not set the flag.
[[nodiscard]] tl::expected<CanFrame, CanReject> parse_can_wire(
    std::span<const std::uint8_t> bytes, CanIdOrder order) noexcept TERRACUT_NONBLOCKING;

/// Writes the frame as a socket expects it, the id in native order. Returns the bytes used: 16
/// or 72.
[[nodiscard]] std::size_t write_can_wire(const CanFrame& frame,
                                         std::span<std::uint8_t, kFdWireBytes> bytes) noexcept
    TERRACUT_NONBLOCKING;

}  // namespace terracut::can
