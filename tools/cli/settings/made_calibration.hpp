// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/cli/options.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

/// The table of the unit whose packets are made: that of --calibration, else the nominal one. The
/// errors are those of the file, and kInvalidArgument where a file is given for a sensor whose
/// table is built in.
namespace terracut::cli {

[[nodiscard]] Expected<hdl64e::Hdl64eCalibration> made_calibration(const CaptureOptions& options,
                                                                   packets::Hdl64eEncoderTraits);
[[nodiscard]] Expected<ruby128::Ruby128Calibration> made_calibration(const CaptureOptions& options,
                                                                     packets::Ruby128EncoderTraits);
[[nodiscard]] Expected<velodyne::VelodyneCalibration> made_calibration(
    const CaptureOptions& options, sensor::SensorModel model);
template <class Model>
[[nodiscard]] Expected<velodyne::VelodyneCalibration> made_calibration(
    const CaptureOptions& options, packets::VelodyneEncoderTraits<Model>) {
  return made_calibration(options, Model::kModel);
}

}  // namespace terracut::cli
