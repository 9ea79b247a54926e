// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <utility>

#include "calib/mount/mount.hpp"
#include "calib/mount/mount_finder.hpp"
#include "calib/sensor_calibration.hpp"
#include "terracut/calibration.hpp"

/// The data behind the public Calibration and Mount, for the folders that build on calib; not
/// installed.
namespace terracut {

struct Calibration::Table {
  calib::SensorCalibration unit;
};

[[nodiscard]] inline Calibration calibration_of(calib::SensorCalibration unit) {
  return Calibration(
      std::make_shared<const Calibration::Table>(Calibration::Table{std::move(unit)}));
}

[[nodiscard]] inline mount::Mount mount_of(const Mount& mount) noexcept {
  return {.height_m = mount.height_m, .roll_rad = mount.roll_rad, .pitch_rad = mount.pitch_rad};
}
[[nodiscard]] inline FoundMount public_mount(const mount::FoundMount& found) noexcept {
  const auto as_public = [](const mount::Mount& of) {
    return Mount{.height_m = of.height_m, .roll_rad = of.roll_rad, .pitch_rad = of.pitch_rad};
  };
  return {as_public(found.mount), as_public(found.uncertainty), found.frames};
}
/// Returns `fault` as an error for users of the library; the message names the settings that help.
[[nodiscard]] inline Error mount_not_found(const Error& fault) {
  return {ErrorCode::kMountNotFound,
          "the mount is not found: " + fault.message +
              "; state Config::mount without find_mount, or go on with it by guess_mount"};
}

}  // namespace terracut
