// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/packet/sensor_model.hpp"
#include "rt/error.hpp"

namespace terracut::sensor {

/// Where a unit's calibration may come from besides its own packets.
struct CalibrationChoice {
  std::optional<calib::SensorCalibration> unit{};  ///< Known already; must be of the model.
  std::filesystem::path file{};  ///< HDL-64E: xml or yaml; RS-Ruby128: csv. Empty: none.
  bool allows_nominal = false;   ///< The model's nominal table of an RS-Ruby128, if all else fails.

  [[nodiscard]] bool is_given() const noexcept { return unit.has_value() || !file.empty(); }
};

/// What the unit's packets say of its calibration; else why they do not, and what to do.
using FromPackets = std::function<Expected<calib::SensorCalibration>()>;

/// The unit's calibration: what is known already; of a model whose table is built in, that; the
/// file; else what its packets say; else, where that is allowed, the model's nominal table.
/// `from_packets` is only asked where there is neither; its error is returned where there is
/// nothing.
[[nodiscard]] Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                                  SensorModel model,
                                                                  const FromPackets& from_packets);

/// kNoCalibration for an HDL-64E S1 at `place`, whose packets never hold one.
[[nodiscard]] tl::unexpected<Error> fail_for_s1(const std::string& place);

/// The same for a capture, whose packets say it in the HDL-64E's status stream and in DIFOP
/// packets. Where they do not: kNoCalibration, with what was found instead. Leaves `source`
/// anywhere.
[[nodiscard]] Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                                  SensorModel model,
                                                                  capture::PcapSource& source);

}  // namespace terracut::sensor
