// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "made_calibration.hpp"

#include <fmt/format.h>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hesai/hesai_csv.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "calib/robosense/unit_table.hpp"
#include "calib/ruby128/ruby128_csv.hpp"

namespace terracut::cli {

Expected<hdl64e::Hdl64eCalibration> made_calibration(const CaptureOptions& options,
                                                     packets::Hdl64eEncoderTraits) {
  if (options.calibration.empty()) return packets::Hdl64eEncoderTraits::nominal();
  return hdl64e::load_hdl64e_calibration(options.calibration);
}

Expected<ruby128::Ruby128Calibration> made_calibration(const CaptureOptions& options,
                                                       packets::Ruby128EncoderTraits) {
  if (options.calibration.empty()) return packets::Ruby128EncoderTraits::nominal();
  return ruby128::read_ruby128_csv(options.calibration);
}

Expected<beams::BeamTable> made_calibration(const CaptureOptions& options,
                                            sensor::SensorModel model) {
  if (options.calibration.empty()) return beams::built_in_table(model);
  if (sensor::is_robosense(model)) return robosense::read_unit_csv(options.calibration, model);
  if (sensor::is_hesai(model)) return hesai::read_hesai_csv(options.calibration, model);
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: the table of a {} is built in; leave --calibration away",
                          options.calibration.string(), to_string(model)));
}

Expected<ouster::OusterCalibration> made_ouster(const CaptureOptions& options,
                                                ouster::Product product,
                                                sensor::SensorModel model) {
  if (options.calibration.empty()) return ouster::nominal_product(product, model);
  return ouster::read_ouster_metadata(options.calibration, model);
}

}  // namespace terracut::cli
