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
/// and, if the kind of file is known, its name and what to do ("1f 8b 08 00: gzip; unpack it
/// first").
[[nodiscard]] std::string describe_first_bytes(std::span<const std::uint8_t> first_bytes);

/// A kind of file that may hold packets or clouds but is not read here.
struct ForeignKind {
  std::string_view name;  ///< Name of the kind and what to do: "gzip; unpack it first (gunzip)".
  bool is_packed;         ///< True if the file is compressed, so that its content is unknown.
};
/// Returns the kind of a file from its first bytes; nothing if unknown.
[[nodiscard]] std::optional<ForeignKind> foreign_kind(std::span<const std::uint8_t> first_bytes);

/// Enough first bytes for all functions in this header.
inline constexpr std::size_t kFirstBytes = 16;

/// True if a file begins as a pcap (either byte order, micro- or nanosecond stamps) or a pcapng.
[[nodiscard]] bool begins_as_capture(std::span<const std::uint8_t> first_bytes);

/// Returns the part of a capture's name before its ending: "drive" of drive.pcap, drive.cap,
/// drive.pcap2 and drive.pcap.1 (tcpdump and logrotate add such numbers), "DRIVE" of DRIVE.PCAPNG.
/// Empty if the name is not a capture's.
[[nodiscard]] std::string_view capture_stem(std::string_view file_name);

}  // namespace terracut::capture
