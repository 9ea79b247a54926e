// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/sensor/sensor_probe.hpp"
#include "firmware_io/streams/sensor_stream.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The sensor of a capture, and how it rotates.
struct SensorChoice {
  streams::SensorStream stream;                              ///< Which datagrams are the unit's.
  sensor::SensorModel model = sensor::SensorModel::kHdl64e;  ///< A decoded one.
  int columns = 0;  ///< For the range image: firings a frame.
  double spin_hz = 0;
  bool dual_return = false;
};

/// The sensors of the model that --sensor wants, or of any, at the beginning of `source`: from
/// different addresses, or told apart as streams::SenderStreams does. Who sends less than a
/// hundredth of what the one heard most does is none, but stray packets. Leaves `source` anywhere.
[[nodiscard]] std::vector<streams::SensorStream> sensors_in(const CaptureOptions& options,
                                                            capture::PcapSource& source);

/// Reads the beginning of `source` and tells which sensor it is of. Errors: kUnsupported, naming
/// what is there instead; kInvalidArgument, naming them and what chooses one, when there are
/// several sensors; those of `source` where it breaks off before a sensor shows. Leaves `source`
/// anywhere; rewind it.
[[nodiscard]] Expected<SensorChoice> choose_sensor(const CaptureOptions& options,
                                                   capture::PcapSource& source);

/// Why datagrams of a capture gave nothing: what its frames were, or the checks they failed.
/// `offered`: those that a decoder was given; `empty`: those it decoded, where no return was in
/// any.
[[nodiscard]] std::string why_nothing_came(const capture::PcapCounters& read, std::uint64_t offered,
                                           std::uint64_t empty, const frame::LossCounters& losses);

/// Says which options have no effect on a sensor of that model.
void warn_of_unused(const CaptureOptions& options, sensor::SensorModel model);

}  // namespace terracut::cli
