// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <utility>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::status {

/// Whether a service manager's watchdog may be fed. Look several times within its time, and at
/// least a few frames apart.
///
/// Since the last look frames met their deadline, and at least as many as missed it; or no packet
/// came at all, or the sensor's head stands: a sensor that is off is not mended by starting the
/// program anew.
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
    // A frame that was skipped and has no stamp is counted as missed and as unjudged.
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
