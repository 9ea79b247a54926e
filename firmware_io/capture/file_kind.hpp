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

/// What a file that is no capture looks like by its first bytes, for error messages: their hex
/// values and, where known, a name and what to do ("1f 8b 08 00: gzip; unpack it first").
[[nodiscard]] std::string describe_first_bytes(std::span<const std::uint8_t> first_bytes);

/// A kind of file that may hold packets or clouds and is not read here.
struct ForeignKind {
  std::string_view name;  ///< And what to do: "gzip; unpack it first (gunzip)".
  bool is_packed;         ///< Whatever may be in it.
};
/// By its first bytes; none: it is of no such kind that is known.
[[nodiscard]] std::optional<ForeignKind> foreign_kind(std::span<const std::uint8_t> first_bytes);

inline constexpr std::size_t kFirstBytes = 16;  ///< Enough for all of these.

/// Whether a file begins as a pcap, of either byte order and either kind of stamps, or a pcapng.
[[nodiscard]] bool begins_as_capture(std::span<const std::uint8_t> first_bytes);

/// What stands before the ending of a capture's name: "drive" of drive.pcap, DRIVE.PCAPNG (as
/// "DRIVE"), drive.cap, and of what tcpdump and logrotate make of them, drive.pcap2, drive.pcap.1.
/// Empty: the name is none of a capture.
[[nodiscard]] std::string_view capture_stem(std::string_view file_name);

}  // namespace terracut::capture
