// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "options.hpp"
#include "rt/error.hpp"
#include "sensor_choice.hpp"

namespace terracut::cli {

/// The unit's calibration, from the first of these that there is:
///
///   HDL-64E      the file of --calibration (xml, yaml); the table in the packets' status stream
///   RS-Ruby128   the file of --calibration (csv); the angles in the DIFOP packets; the model's
///                nominal table, only with --nominal-calibration
///
/// Else kNoCalibration, with what was found instead and what to do. Leaves `source` anywhere.
[[nodiscard]] Expected<calib::SensorCalibration> choose_calibration(
    const CaptureOptions& options, const SensorChoice& sensor, firmware_io::PcapSource& source);

}  // namespace terracut::cli
