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

/// Where the sensor stands as it is stated: --setup, then --mount-... on top, and for what is not
/// a level mount at 1.73 m.
[[nodiscard]] Expected<mount::Mount> mount_of(const MountOptions& options);

/// The ring profile of a unit so mounted. The measured ring distances of a setup count only as long
/// as no --mount-... option moves the sensor away from where they were measured.
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(
    const calib::SensorCalibration& calibration, const MountOptions& options);
[[nodiscard]] Expected<mount::RingProfile> ring_profile_of(const scan::RingTable& rings,
                                                           const MountOptions& options);

/// That each setting, checked, is of a method among `kinds`: one that nothing looks at would be
/// silently without effect. kInvalidArgument, naming it and whose it is.
[[nodiscard]] Status check_used(std::span<const std::string> settings,
                                std::span<const baselines::MethodKind> kinds);

/// The method for --method, or --profile and --stages, and --set; names and settings must have been
/// checked.
[[nodiscard]] baselines::MethodConfig method_config_of(const MethodOptions& options);
[[nodiscard]] inline ground::MethodMaker method_of(const MethodOptions& options) {
  return baselines::maker_of(method_config_of(options));
}

}  // namespace terracut::cli
