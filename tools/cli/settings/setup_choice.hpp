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

/// Returns the stated mount: --setup, overridden by --mount-..., completed by a level mount at 1.73
/// m.
[[nodiscard]] Expected<mount::Mount> mount_of(const MountOptions& options);

/// Returns the ring profile of a unit at the mount of the options. The ring distances measured for
/// a setup count only if no --mount-... option moves the sensor away from the setup's mount.
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(
    const calib::SensorCalibration& calibration, const MountOptions& options);
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(const scan::RingTable& rings,
                                                           const MountOptions& options);

/// Checks that each setting, whose name and value are already checked, belongs to a method among
/// `kinds`: otherwise it would silently have no effect. Fails with kInvalidArgument, naming the
/// setting and its method.
[[nodiscard]] Status check_used(std::span<const std::string> settings,
                                std::span<const baselines::MethodKind> kinds);

/// Returns the method for --method, or --profile and --stages, and --set, whose names and settings
/// must have been checked.
[[nodiscard]] baselines::MethodConfig method_config_of(const MethodOptions& options);
[[nodiscard]] inline ground::MethodMaker method_of(const MethodOptions& options) {
  return baselines::maker_of(method_config_of(options));
}

}  // namespace terracut::cli
