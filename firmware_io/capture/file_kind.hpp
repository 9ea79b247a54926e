// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace terracut::capture {

/// Describes a file that is no capture by its first bytes, for error messages: their hex values
/// and, if known, a name and what to do ("1f 8b 08 00: gzip; unpack it first").
[[nodiscard]] std::string describe_first_bytes(std::span<const std::uint8_t> first_bytes);

/// A kind of file that may hold packets or clouds but is not read here.
struct ForeignKind {
  std::string_view name;  ///< Name and what to do: "gzip; unpack it first (gunzip)".
  bool is_packed;         ///< Packed; its content is unknown.
};
/// Returns the kind by a file's first bytes; nothing if it is unknown.
[[nodiscard]] std::optional<ForeignKind> foreign_kind(std::span<const std::uint8_t> first_bytes);

inline constexpr std::size_t kFirstBytes = 16;  ///< Enough for all functions here.

/// True if a file begins as a pcap, of either byte order and either kind of stamps, or a pcapng.
[[nodiscard]] bool begins_as_capture(std::span<const std::uint8_t> first_bytes);

/// Returns the part of a capture's name before its ending: "drive" of drive.pcap, "DRIVE" of
/// DRIVE.PCAPNG, "drive" of drive.cap and of the names tcpdump and logrotate make of them,
/// drive.pcap2 and drive.pcap.1. Empty if the name is not a capture's.
[[nodiscard]] std::string_view capture_stem(std::string_view file_name);

}  // namespace terracut::capture
