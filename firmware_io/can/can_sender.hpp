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

/// Counts the frames given to a CanSender: their number is sent + queue_full + link_down + failed.
struct CanSendCounters {
  std::uint64_t sent = 0;
  /// Frames not sent because the bus was still busy with earlier ones.
  std::uint64_t queue_full = 0;
  std::uint64_t link_down = 0;  ///< Frames not sent because the interface was down or missing.
  std::uint64_t failed = 0;     ///< Frames not sent for another reason.
  int last_error = 0;           ///< errno of the last frame that was not sent.
};

/// Sends frames on a CAN interface and never waits: a frame that cannot go out at once is dropped
/// and counted. An interface that went away is used again when it comes back. Receives nothing. One
/// thread, which needs no priority.
class CanSender {
 public:
  /// Opens the interface. Fails as SocketCanSource::open() does; with `wait_for_interface` a
  /// missing interface is no error: it is used when it comes.
  [[nodiscard]] static Expected<CanSender> open(std::string interface,
                                                bool wait_for_interface = false);

  /// Makes a sender for any datagram socket, in the format that SocketCanSource::adopt() receives.
  [[nodiscard]] static CanSender adopt(files::OwnedDescriptor descriptor);

  /// Sends `frames` and returns how many were sent; the others are counted by reason.
  std::size_t send(std::span<const CanFrame> frames) noexcept;

  /// True if the interface existed at the last look.
  [[nodiscard]] bool has_interface() const noexcept { return static_cast<bool>(socket_); }
  [[nodiscard]] const CanSendCounters& counters() const noexcept { return counters_; }

 private:
  CanSender() = default;
  [[nodiscard]] bool send(const CanFrame& frame) noexcept;
  void look_after_interface() noexcept;

  std::string interface_;         ///< Empty if the socket was adopted.
  files::OwnedDescriptor probe_;  ///< An idle socket, used to ask the kernel about interfaces.
  files::OwnedDescriptor socket_;
  int interface_index_ = 0;
  std::int64_t next_look_ns_ = 0;
  CanSendCounters counters_;
};

}  // namespace terracut::can
