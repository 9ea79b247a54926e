// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "pipeline/ground/profile.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"
#include "tools/research/baselines/method_config.hpp"

namespace terracut::cli {

/// Returns the stated mount: that of --setup, overridden by --mount-...; figures not stated are
/// those of a level mount at 1.73 m.
[[nodiscard]] Expected<mount::Mount> mount_of(const MountOptions& options);

/// Returns a unit's ring profile for the mount of the options. The ring distances measured for a
/// setup are used only if no --mount-... option changes the setup's mount.
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(
    const calib::SensorCalibration& calibration, const MountOptions& options);
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(const scan::RingTable& rings,
                                                           const MountOptions& options);

/// Checks that each setting belongs to a method among `kinds`: otherwise it would silently have no
/// effect. Names and values must have been checked. Fails with kInvalidArgument, naming the setting
/// and its method.
[[nodiscard]] Status check_used(std::span<const std::string> settings,
                                std::span<const baselines::MethodKind> kinds);

/// Returns the method that --method, or --profile, --stages and --set describe. Names and settings
/// must have been checked.
[[nodiscard]] baselines::MethodConfig method_config_of(const MethodOptions& options);
[[nodiscard]] inline ground::MethodMaker method_of(const MethodOptions& options) {
  return baselines::maker_of(method_config_of(options));
}
/// Returns what makes the method for the turns of a sensor.
[[nodiscard]] inline ground::TurnMethodMaker turn_method_of(const MethodOptions& options) {
  return baselines::turn_maker_of(method_config_of(options));
}

}  // namespace terracut::cli
