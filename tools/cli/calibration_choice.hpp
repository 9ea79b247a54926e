// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "options.hpp"
#include "rt/error.hpp"
#include "sensor_choice.hpp"

namespace terracut::cli {

/// Says which options have no effect on a sensor of that model.
void warn_of_unheeded(const CaptureOptions& options, firmware_io::SensorModel model);

/// What the unit's packets say of its calibration; else why they do not, and what to do.
using ToldCalibration = std::function<Expected<calib::SensorCalibration>()>;

/// The unit's calibration, from the first of these that there is:
///
///   HDL-64E      the file of --calibration (xml, yaml); what its packets tell
///   RS-Ruby128   the file of --calibration (csv); what its packets tell; the model's nominal
///   table,
///                only with --nominal-calibration
///
/// Else the error of `told`, which is only asked where there is no file.
[[nodiscard]] Expected<calib::SensorCalibration> choose_calibration(const CaptureOptions& options,
                                                                    firmware_io::SensorModel model,
                                                                    const ToldCalibration& told);

/// Where the packets told a table that is not the one in use: both fingerprints and what to do.
/// Empty where they told none, or this one.
[[nodiscard]] std::string other_table_warning(const firmware_io::StatusStreamReader& told,
                                              const calib::SensorCalibration& in_use);

/// The same for a capture, whose packets tell in the HDL-64E's status stream and in DIFOP packets.
/// Where they do not: kNoCalibration, with what was found instead. Leaves `source` anywhere.
[[nodiscard]] Expected<calib::SensorCalibration> choose_calibration(
    const CaptureOptions& options, const SensorChoice& sensor, firmware_io::PcapSource& source);

}  // namespace terracut::cli
