// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/sensor/sensor_probe.hpp"
#include "firmware_io/streams/sensor_stream.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The sensor of a capture and its columns.
struct SensorChoice {
  streams::SensorStream stream;                              ///< Selects the unit's datagrams.
  sensor::SensorModel model = sensor::SensorModel::kHdl64e;  ///< One that can be decoded.
  int columns = 0;  ///< Of the range image: firings per frame.
  double spin_hz = 0;
  bool dual_return = false;
};

/// Returns the model that the user has named: that of --sensor, or of an Ouster's metadata given as
/// --calibration.
[[nodiscard]] std::optional<sensor::SensorModel> named_model(const CaptureOptions& options);

/// Returns the sensors at the beginning of `source`, of the model of --sensor or of any, told apart
/// by address or as in streams::SenderStreams. A sender of less than a hundredth of the busiest
/// one's packets is ignored as stray. Leaves `source` at any position.
[[nodiscard]] std::vector<streams::SensorStream> sensors_in(const CaptureOptions& options,
                                                            capture::CaptureSource& source);

/// Reads the beginning of `source` and identifies its sensor. Fails with kUnsupported, naming what
/// was found instead; kInvalidArgument for several sensors, naming them and the options that choose
/// one; those of `source` if it breaks off before a sensor shows. Leaves `source` at any position;
/// rewind it.
[[nodiscard]] Expected<SensorChoice> choose_sensor(const CaptureOptions& options,
                                                   capture::CaptureSource& source);

/// Explains why datagrams of a capture gave no frame: what they were, or the checks they failed.
/// `offered` were given to a decoder; `empty` were decoded but held no return.
[[nodiscard]] std::string why_nothing_came(const capture::CaptureCounters& read,
                                           std::uint64_t offered, std::uint64_t empty,
                                           const frame::LossCounters& losses);

/// Warns of options that have no effect on a sensor of that model.
void warn_of_unused(const CaptureOptions& options, sensor::SensorModel model);

}  // namespace terracut::cli
