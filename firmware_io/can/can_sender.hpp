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
  std::uint64_t queue_full = 0;  ///< Not sent: the bus was still busy with earlier frames.
  std::uint64_t link_down = 0;   ///< Not sent: the interface was down or missing.
  std::uint64_t failed = 0;      ///< Not sent for another reason.
  int last_error = 0;            ///< errno of the last one in `failed` or above.
};

/// Sends frames on a CAN interface and never waits: a frame that cannot go out at once is dropped
/// and counted. An interface that went away is used again when it comes back. Receives nothing. One
/// thread, which needs no priority.
class CanSender {
 public:
  /// Errors of SocketCanSource::open(). With `wait_for_interface` a missing interface is no error:
  /// it is used when it comes.
  [[nodiscard]] static Expected<CanSender> open(std::string interface,
                                                bool wait_for_interface = false);

  /// Sends over any datagram socket, as SocketCanSource::adopt() receives.
  [[nodiscard]] static CanSender adopt(files::OwnedDescriptor descriptor);

  /// Returns how many were sent; the others are counted by reason.
  std::size_t send(std::span<const CanFrame> frames) noexcept;

  /// True if an interface was there when last looked for.
  [[nodiscard]] bool has_interface() const noexcept { return static_cast<bool>(socket_); }
  [[nodiscard]] const CanSendCounters& counters() const noexcept { return counters_; }

 private:
  CanSender() = default;
  [[nodiscard]] bool send(const CanFrame& frame) noexcept;
  void look_after_interface() noexcept;

  std::string interface_;         ///< Empty when adopted.
  files::OwnedDescriptor probe_;  ///< An idle socket for asking about interfaces.
  files::OwnedDescriptor socket_;
  int interface_index_ = 0;
  std::int64_t next_look_ns_ = 0;
  CanSendCounters counters_;
};

}  // namespace terracut::can
