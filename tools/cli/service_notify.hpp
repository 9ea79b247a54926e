// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::cli {

/// Tells systemd how the service does, by datagrams to $NOTIFY_SOCKET (the protocol of
/// sd_notify(3)). Outside a service it does nothing. From normal threads only; never blocks.
class ServiceNotify {
 public:
  /// By $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID. kInvalidArgument for a socket address of
  /// another kind than a path or an abstract name, or one that is too long.
  [[nodiscard]] static Expected<ServiceNotify> from_environment();

  ServiceNotify() noexcept = default;
  ServiceNotify(ServiceNotify&& other) noexcept;
  ServiceNotify& operator=(ServiceNotify&& other) noexcept;
  ~ServiceNotify();

  [[nodiscard]] bool connected() const noexcept { return descriptor_ >= 0; }
  /// Within which time the watchdog has to be fed; none: nobody watches.
  [[nodiscard]] std::optional<std::int64_t> watchdog_ns() const noexcept { return watchdog_ns_; }

  /// Start-up is done: the unit counts as started. `status` is what `systemctl status` shows.
  bool ready(std::string_view status) const noexcept;
  bool status(std::string_view status) const noexcept;
  bool feed_watchdog() const noexcept;
  bool stopping() const noexcept;

 private:
  [[nodiscard]] bool send(std::string_view message) const noexcept;

  int descriptor_ = -1;
  std::optional<std::int64_t> watchdog_ns_;
};

/// Running counts of a live process.
struct ServiceCounts {
  std::uint64_t packets = 0;  ///< Received.
  std::uint64_t on_time = 0;  ///< Frames whose labels met the deadline.
  std::uint64_t missed = 0;   ///< Frames that did not, or were skipped.
};

/// Whether the watchdog may be fed. Look several times within its time, and at least a few frames
/// apart.
///
/// Since the last look frames met their deadline, and at least as many as missed it; or no packet
/// came at all, for a sensor that is off is not mended by starting the program anew.
class WatchdogRule {
 public:
  [[nodiscard]] bool may_feed(const ServiceCounts& now) noexcept;

 private:
  ServiceCounts before_;
};

}  // namespace terracut::cli
