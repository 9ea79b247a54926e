// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::cli {

/// Reports the service's state to systemd by datagrams to $NOTIFY_SOCKET (the protocol of
/// sd_notify(3)). Outside a service it does nothing. From normal threads only; never blocks.
class ServiceNotify {
 public:
  /// Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID. Fails with kInvalidArgument if the
  /// socket's address is neither a path nor an abstract name, or is too long; kNotFound if nobody
  /// listens.
  [[nodiscard]] static Expected<ServiceNotify> from_environment();

  [[nodiscard]] bool connected() const noexcept { return static_cast<bool>(socket_); }
  /// Returns the time within which the watchdog must be fed; none without a watchdog.
  [[nodiscard]] std::optional<std::int64_t> watchdog_ns() const noexcept { return watchdog_ns_; }

  /// Reports the end of the start-up: the unit then counts as started. `systemctl status` shows
  /// `status`, cut after 200 bytes. This and the following functions return true if systemd took
  /// the message; a refused message is no reason to stop.
  bool ready(std::string_view status) const noexcept;
  bool status(std::string_view status) const noexcept;
  bool feed_watchdog() const noexcept;
  bool stopping() const noexcept;

 private:
  [[nodiscard]] bool send(std::string_view message) const noexcept;

  files::OwnedDescriptor socket_;
  std::optional<std::int64_t> watchdog_ns_;
};

}  // namespace terracut::cli
