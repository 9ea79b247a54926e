// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/sensor/sensor_probe.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The sensor of a capture, and how it rotates.
struct SensorChoice {
  std::uint32_t address = 0;                                 ///< IPv4 of the unit, as in Datagram.
  sensor::SensorModel model = sensor::SensorModel::kHdl64e;  ///< A decoded one.
  int columns = 0;  ///< For the range image: firings a frame.
  double spin_hz = 0;
  bool dual_return = false;
};

/// Reads the beginning of `source` and tells which sensor it is of: the one of --sensor, or the one
/// found. Of several units each has its address; one that sends less than a hundredth of what the
/// one heard most does is none, but stray packets. Errors: kUnsupported, naming the models found
/// instead; kInvalidArgument, naming them, when there are several sensors. Leaves `source`
/// anywhere; rewind it.
[[nodiscard]] Expected<SensorChoice> choose_sensor(const CaptureOptions& options,
                                                   capture::PcapSource& source);

/// Why datagrams of a capture gave nothing: what its frames were, or the checks they failed.
[[nodiscard]] std::string why_nothing_came(const capture::PcapCounters& read, std::uint64_t offered,
                                           const frame::LossCounters& losses);

/// Says which options have no effect on a sensor of that model.
void warn_of_unused(const CaptureOptions& options, sensor::SensorModel model);

}  // namespace terracut::cli
