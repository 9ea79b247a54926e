// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::send {

/// The faults between a sensor and its receiver. "From T on" means from the first packet whose
/// stamp is at least T after the stream's first stamp. N counts the packets that earlier faults
/// have not removed.
enum class FaultKind : std::uint8_t {
  kLoss,       ///< N packets from T on are never sent.
  kReorder,    ///< One packet, the first from T on, is sent after the N that follow it.
  kDuplicate,  ///< N packets from T on are sent twice in a row.
  kPause,      ///< Packets during a time span from T on are never sent: the sensor falls silent.
  kBurst,      ///< Packets during a time span from T on are held back and sent together at its end.
  kForeign,    ///< N packets of another device are sent before the first packet from T on.
  kTruncate,   ///< N packets from T on are sent with only the first half of their bytes.
  kClock,      ///< The device's clock jumps at T and keeps the offset.
};

/// Returns a stable lower-case name such as "loss", as in scripts.
[[nodiscard]] std::string_view to_string(FaultKind kind) noexcept;

struct Fault {
  FaultKind kind = FaultKind::kLoss;
  std::int64_t at_ns = 0;     ///< T, since the stream's first packet.
  std::uint64_t packets = 0;  ///< N; unused by pause, burst and clock.
  std::int64_t span_ns = 0;   ///< Length of a pause or burst; signed jump of a clock.

  friend bool operator==(const Fault&, const Fault&) = default;
};

/// Returns the text for parse_fault_script(): "loss@2.5s:20packets", "clock@8s:-2s".
[[nodiscard]] std::string to_string(const Fault& fault);

using FaultScript = std::vector<Fault>;

/// Reads faults separated by commas, semicolons or blanks, in any order:
///
///   loss@2.5s:20packets reorder@4s:3 duplicate@4.5s:2 pause@5s:0.4s burst@6s:50ms
///   foreign@7s:50 truncate@9s:5 clock@8s:+2.0s
///
/// Times take s or ms, [0, 1e6] s; counts may carry "packets", [1, 1e9]; a clock needs its sign. An
/// empty text means no faults. Fails with kInvalidArgument; the message names the fault and what
/// was expected.
[[nodiscard]] Expected<FaultScript> parse_fault_script(std::string_view text);

}  // namespace terracut::send
