// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "firmware_io/can/can_frame.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::can {

/// Frames given to a CanSender are sent + queue_full + link_down + failed.
struct CanSendCounters {
  std::uint64_t sent = 0;
  std::uint64_t queue_full = 0;  ///< Left out: the bus was too busy for what was to be sent before.
  std::uint64_t link_down = 0;   ///< Left out: the interface was down or not there.
  std::uint64_t failed = 0;      ///< Refused for another reason.
  int last_error = 0;            ///< errno of the newest of these.
};

/// Sends frames on a CAN interface and never waits: what does not go out at once is left out and
/// counted. An interface that went away and came back is taken up again. Hears nothing. One thread,
/// which needs no priority.
class CanSender {
 public:
  /// Errors as SocketCanSource::open. `wait_for_interface`: one that is not there is taken up when
  /// it comes.
  [[nodiscard]] static Expected<CanSender> open(std::string interface,
                                                bool wait_for_interface = false);

  /// Over any datagram socket, as SocketCanSource::adopt.
  [[nodiscard]] static CanSender adopt(files::OwnedDescriptor descriptor);

  /// Returns how many were sent; the others are counted by why they were not.
  std::size_t send(std::span<const CanFrame> frames) noexcept;

  /// Whether there is one to send on, or was when it was last looked for.
  [[nodiscard]] bool has_interface() const noexcept { return static_cast<bool>(socket_); }
  [[nodiscard]] const CanSendCounters& counters() const noexcept { return counters_; }

 private:
  CanSender() = default;
  [[nodiscard]] bool send(const CanFrame& frame) noexcept;
  void look_after_interface() noexcept;

  std::string interface_;         ///< Empty when adopted.
  files::OwnedDescriptor probe_;  ///< An idle socket to ask for interfaces with.
  files::OwnedDescriptor socket_;
  int interface_index_ = 0;
  std::int64_t next_look_ns_ = 0;
  CanSendCounters counters_;
};

}  // namespace terracut::can
