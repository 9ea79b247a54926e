// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "firmware_io/can/can_frame.hpp"

namespace terracut::can {

/// One frame as a line of the log format of can-utils (`candump -l`, `candump -L`), which most
/// tools for CAN read and write:
///
///     (1700000000.123456) can0 0AA#1A2B3C       11-bit id, 3 bytes
///     (1700000000.123456) can0 18FEF100#R8      29-bit id (8 digits), remote, asks for 8
///     (1700000000.123456) can0 20000040#00      error frame: bit 29 of the number is set
///     (1700000000.123456) can0 123##5AABBCC     FD; the digit holds its flags:
///                                               1 bit rate switch, 2 sender passive, 4 FD
///
/// The stamp has 1 to 9 decimals; data may be separated by dots; a last word " R" or " T" tells
/// received from sent.
struct CandumpLine {
  CanFrame frame;
  std::string_view interface;  ///< Points into the line that was parsed.
};

/// What is wrong with a line. `what` is a text of static duration, for a message. A well-formed
/// line that is no frame (`DROPCOUNT`, a comment, CAN XL) is not `malformed`.
struct CandumpFault {
  std::string_view what;
  bool malformed = true;
};

/// Parses `line`, given without its line end. Accepts any bytes. Allocates nothing.
[[nodiscard]] tl::expected<CandumpLine, CandumpFault> parse_candump_line(
    std::string_view line) noexcept;

/// Returns the line for a frame, with its line end. The stamp must not be negative; it is written
/// with 6 decimals, or 9 if the nanoseconds need them.
[[nodiscard]] std::string candump_line(const CanFrame& frame, std::string_view interface);

}  // namespace terracut::can
