// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::simulation {

/// What may go wrong around a live run.
enum class FaultKind : std::uint8_t {
  kLoss,           ///< The network loses `amount` packets.
  kReorder,        ///< A packet is overtaken by `amount` others.
  kDuplicate,      ///< `amount` packets come twice.
  kTruncated,      ///< `amount` packets come with half of their bytes.
  kGarbage,        ///< `amount` datagrams of no sensor come at once, from the sensor's address.
  kBurst,          ///< Packets are held back and come together at the end.
  kCablePulled,    ///< The interface is down.
  kSensorRestart,  ///< No packets; then head and clock begin anew, the head at turn `amount`/1000.
  kDeviceClock,    ///< The sensor's clock is set by `amount` ms.
  kDeviceClockSlow,  ///< The sensor's clock runs at 1/`amount` of its pace.
  kHeadStands,       ///< The head does not rotate.
  kOtherSender,      ///< `amount` datagrams a second come from another address.
  kTwin,             ///< Another sensor of that model sends as well, from the sensor's address.
  kHostClock,        ///< The machine's time of day is set by `amount` ms.
  kStolenCore,       ///< The labelling thread does not run.
  kSlowWork,         ///< All work takes `amount` times as long.
  kOutletStalls,     ///< Nobody takes labelled points.
  kLabelsStall,      ///< Nobody takes labels.
  kMonitorStalls,    ///< Nobody judges frames.
  kMotionStops,      ///< The vehicle's motion is not told.
  kCount,
};

/// Returns a stable lower_snake_case name; "unknown" for anything else.
[[nodiscard]] std::string_view to_string(FaultKind kind) noexcept;

/// A fault in whole milliseconds of the run. What `amount` means depends on the kind.
struct Fault {
  FaultKind kind{};
  std::int64_t at_ms = 0, span_ms = 0, amount = 0;

  [[nodiscard]] std::int64_t at_ns() const noexcept { return at_ms * 1'000'000; }
  [[nodiscard]] std::int64_t end_ns() const noexcept { return (at_ms + span_ms) * 1'000'000; }
  [[nodiscard]] bool is_on(FaultKind asked, std::int64_t now_ns) const noexcept {
    return kind == asked && now_ns >= at_ns() && now_ns < end_ns();
  }
  friend bool operator==(const Fault&, const Fault&) = default;
};
using Faults = std::vector<Fault>;

/// Returns the faults of a seed: one to eight, between the second and the eighteenth second.
[[nodiscard]] Faults faults_of(std::uint64_t seed);

/// Returns for example "stolen_core@2013+250*0 loss@4000+0*12": kind@at_ms+span_ms*amount.
[[nodiscard]] std::string to_string(const Faults& faults);
/// Reads what to_string() wrote. Fails with kInvalidArgument, naming the word it cannot read.
[[nodiscard]] Expected<Faults> parse_faults(std::string_view text);

}  // namespace terracut::simulation
