// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/sensor_model.hpp"
#include "live_options.hpp"
#include "live_source.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Who sends, and what is needed to decode it.
struct SensorOnAir {
  std::uint32_t address = 0;  ///< IPv4, as in Datagram.
  firmware_io::SensorModel model{};
  int columns = 0;  ///< For the range image: firings a turn.
  double spin_hz = 0;
  bool dual_return = false;
  calib::SensorCalibration calibration;
};

/// Listens until a sensor is known and, where no calibration was given, it has told its own: an
/// HDL-64E in its data packets, an RS-Ruby128 at `options.listen.device_port`. Allocates; takes as
/// long as it takes, at most `options.patience_s` where there is such, or until stop_wanted().
/// `on_waiting` is told many times a second what is waited for.
///
/// kUnsupported: nobody sends what can be decoded; the message says what came instead.
/// kInvalidArgument: several sensors do, which --from must tell apart. kNoCalibration: none was
/// given nor sent. The errors of the calibration file.
using OnWaiting = std::function<void(const std::string& what)>;
[[nodiscard]] Expected<SensorOnAir> listen_for_sensor(LiveSource& source,
                                                      const LiveOptions& options,
                                                      const OnWaiting& on_waiting);

}  // namespace terracut::cli
