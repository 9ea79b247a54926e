// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <utility>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::status {

/// Decides whether to feed a service manager's watchdog. Call it several times within the
/// watchdog's time, and at least a few frames apart.
///
/// The watchdog is fed if, since the last call, at least as many frames met their deadline as
/// missed it. It is also fed if no packet came at all or the sensor's head stands still, because
/// restarting the program does not mend a sensor that is off.
class WatchdogRule {
 public:
  [[nodiscard]] bool may_feed(const MonitorSnapshot& figures) noexcept {
    const Counts now{.packets = figures.packets,
                     .frames = figures.frames,
                     .missed = figures.all_misses(),
                     .unjudged = figures.unjudged};
    const Counts before = std::exchange(before_, now);
    const std::uint64_t missed = now.missed - before.missed;
    if (now.packets == before.packets && missed == 0) return true;
    if (figures.head_stands) return true;
    // A skipped frame without a stamp is counted both as missed and as unjudged.
    const std::uint64_t not_in_time = missed + (now.unjudged - before.unjudged);
    const std::uint64_t frames = now.frames - before.frames;
    return frames > not_in_time && frames - not_in_time >= missed;
  }

 private:
  struct Counts {
    std::uint64_t packets = 0, frames = 0, missed = 0, unjudged = 0;
  };
  Counts before_;
};

}  // namespace terracut::status
