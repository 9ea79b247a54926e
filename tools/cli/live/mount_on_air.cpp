// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_on_air.hpp"

#include "pipeline/run/mount_on_air.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

MountChoice mount_on_air(net::LiveSource& source, const sensor::SensorOnAir& sensor,
                         const Options& options, const OnWaiting& on_waiting) {
  if (!is_mount_open(options.mount)) return {options.mount, {}};
  const mount::MountFinder finder = run::mount_on_air(
      source, sensor, decoder_config_of(options, sensor.columns, FramesAreFor::kPoints),
      stop_wanted, [&] { on_waiting("finding the mount"); });
  return choose_mount(options.mount, finder);
}

}  // namespace terracut::cli
