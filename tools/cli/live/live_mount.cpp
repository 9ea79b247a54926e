// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/live/live_mount.hpp"

#include "pipeline/run/mount_on_air.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

MountChoice mount_on_air(net::LiveSource& source, const streams::SensorOnAir& sensor,
                         const Options& options, const OnWaiting& on_waiting) {
  if (!is_mount_open(options.mount)) return {.options = options.mount};
  constexpr std::chrono::seconds kForAGuess{3};
  const mount::MountFinder finder = run::mount_on_air(
      source, sensor, decoder_config_of(options, sensor.columns),
      options.mount.may_guess ? kForAGuess : run::kGroundPatience, stop_wanted, on_waiting);
  return choose_mount(guessing(options.mount), finder).value();
}

}  // namespace terracut::cli
