// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/cli/options.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

/// Returns the table of the unit whose packets are to be made: that of --calibration, otherwise the
/// nominal one. Fails with the errors of the file; kInvalidArgument if a file is given for a sensor
/// with a factory table.
namespace terracut::cli {

[[nodiscard]] Expected<hdl64e::Hdl64eCalibration> made_calibration(const CaptureOptions& options,
                                                                   packets::Hdl64eEncoderTraits);
[[nodiscard]] Expected<ruby128::Ruby128Calibration> made_calibration(const CaptureOptions& options,
                                                                     packets::Ruby128EncoderTraits);
[[nodiscard]] Expected<beams::BeamTable> made_calibration(const CaptureOptions& options,
                                                          sensor::SensorModel model);
template <class Model, class Sender>
[[nodiscard]] Expected<beams::BeamTable> made_calibration(
    const CaptureOptions& options, packets::TableEncoderTraits<Model, Sender>) {
  return made_calibration(options, Model::kModel);
}
[[nodiscard]] Expected<ouster::OusterCalibration> made_ouster(const CaptureOptions& options,
                                                              ouster::Product product,
                                                              sensor::SensorModel model);
template <int kRows>
[[nodiscard]] Expected<ouster::OusterCalibration> made_calibration(
    const CaptureOptions& options, packets::OusterEncoderTraits<kRows>,
    ouster::Product product = ouster::Product::kOs1) {
  return made_ouster(options, product, ouster::model_of_rows(kRows));
}

}  // namespace terracut::cli
