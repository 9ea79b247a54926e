// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "setup_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "calib/angle.hpp"
#include "calib/sensor_setup_file.hpp"
#include "pipeline/parameter_table.hpp"

namespace terracut::cli {
namespace {

bool moved_by_options(const MountOptions& options) {
  return options.height_m || options.roll_deg || options.pitch_deg;
}

Expected<calib::SensorSetup> setup_of(const MountOptions& options) {
  calib::SensorSetup setup;
  if (!options.setup.empty()) {
    Expected<calib::SensorSetup> read = calib::read_sensor_setup(options.setup);
    if (!read) return read;
    setup = *std::move(read);
  }
  if (options.height_m) setup.mount.height_m = *options.height_m;
  if (options.roll_deg) setup.mount.roll_rad = calib::deg_to_rad(*options.roll_deg);
  if (options.pitch_deg) setup.mount.pitch_rad = calib::deg_to_rad(*options.pitch_deg);
  if (moved_by_options(options)) setup.ring_ground_distance_m.clear();
  return setup;
}

}  // namespace

Expected<calib::Mount> mount_of(const MountOptions& options) {
  return setup_of(options).map([](const calib::SensorSetup& setup) { return setup.mount; });
}

Expected<calib::RingProfile> ring_profile_of(const calib::SensorCalibration& calibration,
                                             const MountOptions& options) {
  const Expected<calib::SensorSetup> setup = setup_of(options);
  if (!setup) return tl::unexpected(setup.error());
  calib::RingProfile profile = calib::ring_profile(calibration, setup->mount);
  if (Status applied = calib::apply_setup(*setup, profile); !applied) {
    return tl::unexpected(applied.error());
  }
  return profile;
}

Status check_heeded(std::span<const std::string> settings,
                    std::span<const pipeline::MethodKind> kinds) {
  for (const std::string& setting : settings) {
    const std::string key = setting.substr(0, setting.find('='));
    const pipeline::MethodKind kind = pipeline::kind_that_heeds(key);
    if (std::ranges::find(kinds, kind) != kinds.end()) continue;
    const std::string whose = kind == pipeline::MethodKind::kSegmenter
                                  ? "our own method"
                                  : "the method " + key.substr(0, key.find('.'));
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("'{}' would change nothing: it is a parameter of {}, which does not "
                            "run here",
                            setting, whose));
  }
  return {};
}

pipeline::MethodConfig method_config_of(const MethodOptions& options) {
  pipeline::MethodConfig config =
      options.profile == "paper" ? pipeline::paper_profile() : pipeline::terracut_profile();
  if (options.stages == "elevation") config.segmenter.last_stage = pipeline::Stage::kElevationMap;
  if (options.stages == "adjacent") config.segmenter.last_stage = pipeline::Stage::kAdjacentPoints;
  if (!options.method.empty()) config = pipeline::method_named(options.method).value();
  for (const std::string& setting : options.settings)
    (void)pipeline::apply_setting(config, setting);
  return config;
}

pipeline::SegmenterConfig segmenter_config_of(const MethodOptions& options) {
  return method_config_of(options).segmenter;
}

}  // namespace terracut::cli
