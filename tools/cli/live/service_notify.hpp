// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::cli {

/// Tells systemd how the service does, by datagrams to $NOTIFY_SOCKET (the protocol of
/// sd_notify(3)). Outside a service it does nothing. From normal threads only; never blocks.
class ServiceNotify {
 public:
  /// By $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID. kInvalidArgument for a socket address of
  /// another kind than a path or an abstract name, or one that is too long; kNotFound where nobody
  /// listens.
  [[nodiscard]] static Expected<ServiceNotify> from_environment();

  [[nodiscard]] bool connected() const noexcept { return static_cast<bool>(socket_); }
  /// Within which time the watchdog has to be fed; none: nobody watches.
  [[nodiscard]] std::optional<std::int64_t> watchdog_ns() const noexcept { return watchdog_ns_; }

  /// Each returns whether the message was taken; one that was not is no reason to stop.
  /// Start-up is done: the unit counts as started. `status` is what `systemctl status` shows, cut
  /// after 200 bytes.
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
