// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "setup_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "calib/beams/angle.hpp"
#include "calib/mount/sensor_setup_file.hpp"
#include "tools/research/baselines/parameter_table.hpp"

namespace terracut::cli {
namespace {

bool moved_by_options(const MountOptions& options) {
  return options.height_m || options.roll_deg || options.pitch_deg;
}

Expected<mount::SensorSetup> setup_of(const MountOptions& options) {
  mount::SensorSetup setup;
  if (!options.setup.empty()) {
    Expected<mount::SensorSetup> read = mount::read_sensor_setup(options.setup);
    if (!read) return read;
    setup = *std::move(read);
  }
  if (options.height_m) setup.mount.height_m = *options.height_m;
  if (options.roll_deg) setup.mount.roll_rad = beams::deg_to_rad(*options.roll_deg);
  if (options.pitch_deg) setup.mount.pitch_rad = beams::deg_to_rad(*options.pitch_deg);
  if (moved_by_options(options)) setup.ring_ground_distance_m.clear();
  return setup;
}

/// Returns the ring profile by the options; `at_mount` returns the unit's profile for a mount.
template <class AtMount>
Expected<mount::RingProfile> profile_by(const AtMount& at_mount, const MountOptions& options) {
  const Expected<mount::SensorSetup> setup = setup_of(options);
  if (!setup) return tl::unexpected(setup.error());
  mount::RingProfile profile = at_mount(setup->mount);
  if (Status applied = mount::apply_setup(*setup, profile); !applied) {
    return tl::unexpected(applied.error());
  }
  return profile;
}

}  // namespace

Expected<mount::Mount> mount_of(const MountOptions& options) {
  return setup_of(options).map([](const mount::SensorSetup& setup) { return setup.mount; });
}

Expected<mount::RingProfile> ring_profile_of(const calib::SensorCalibration& calibration,
                                             const MountOptions& options) {
  return profile_by(
      [&](const mount::Mount& mount) { return calib::ring_profile(calibration, mount); }, options);
}

Expected<mount::RingProfile> ring_profile_of(const scan::RingTable& rings,
                                             const MountOptions& options) {
  return profile_by([&](const mount::Mount& mount) { return scan::ring_profile(rings, mount); },
                    options);
}

Status check_used(std::span<const std::string> settings,
                  std::span<const baselines::MethodKind> kinds) {
  for (const std::string& setting : settings) {
    const std::string key = setting.substr(0, setting.find('='));
    const baselines::MethodKind kind = baselines::kind_that_uses(key);
    if (std::ranges::find(kinds, kind) != kinds.end()) continue;
    const std::string whose = kind == baselines::MethodKind::kSegmenter
                                  ? "our own method"
                                  : "the method " + key.substr(0, key.find('.'));
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("'{}' would change nothing: it is a parameter of {}, which does not "
                            "run here",
                            setting, whose));
  }
  return {};
}

baselines::MethodConfig method_config_of(const MethodOptions& options) {
  baselines::MethodConfig config;
  if (options.profile == Profile::kPaper) config.segmenter = ground::paper_profile();
  config.segmenter.last_stage = options.last_stage;
  if (!options.method.empty()) config = baselines::method_named(options.method).value();
  config.segmenter.gives_heights = options.gives_heights();
  for (const std::string& setting : options.settings) {
    (void)baselines::apply_setting(config, setting);
  }
  return config;
}

}  // namespace terracut::cli
