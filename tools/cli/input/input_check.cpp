// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "input_check.hpp"

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "firmware_io/vehicle/dbc_file.hpp"
#include "terracut/calibration.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

template <class Calibration>
Status status_of(const Expected<Calibration>& read) {
  return read ? Status{} : tl::unexpected(read.error());
}

Status check_calibration(const CaptureOptions& capture) {
  const std::filesystem::path& file = capture.calibration;
  if (file.empty()) return {};
  if (capture.sensor && sensor::has_built_in_table(*capture.sensor)) {
    return status_of(sensor::unit_calibration({{}, file, false}, *capture.sensor, {}));
  }
  if (capture.sensor && sensor::is_ouster(*capture.sensor)) {
    return status_of(ouster::read_ouster_metadata(file, capture.sensor));
  }
  const auto ruby128 = [&] { return status_of(ruby128::read_ruby128_csv(file)); };
  if (capture.sensor == sensor::SensorModel::kHdl64e) {
    return status_of(hdl64e::load_hdl64e_calibration(file));
  }
  if (capture.sensor == sensor::SensorModel::kRuby128) return ruby128();
  const Status of_any = status_of(Calibration::load(file));
  return of_any || ruby128() ? Status{} : of_any;
}

}  // namespace

Status check_inputs(const Options& options) {
  if (Status calibration = check_calibration(options.capture); !calibration) return calibration;
  if (Status mount = status_of(mount_of(options.mount)); !mount) return mount;
  if (options.motion.dbc.empty()) return {};
  return status_of(vehicle::read_dbc(options.motion.dbc));
}

}  // namespace terracut::cli
