// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/socket.h>

#include <ctime>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/can_receive_counters.hpp"
#include "firmware_io/can/can_wire.hpp"
#include "firmware_io/net/drop_counter.hpp"
#include "firmware_io/net/network_interface.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::can {

struct SocketCanConfig {
  std::string interface{};   ///< "can0"
  std::vector<CanId> ids{};  ///< The messages to receive, 1 to 512 ids; the kernel filters.
  std::size_t batch = 64;    ///< The most frames that receive() returns, > 0.
  std::size_t receive_buffer_bytes = 1U << 20;  ///< Enough for about 1300 frames.
  /// True: a missing interface is no error; it is used when it comes.
  bool wait_for_interface = false;
};

/// Receives frames of a CAN interface, many with one system call, with the kernel's time stamps and
/// its count of drops.
///
/// All memory is taken in open(); receive() never allocates, throws or waits longer than told. If
/// the interface goes down, or disappears and comes back under its name, receive() returns nothing,
/// looks for it twice a second, opens it again when it can, and counts. One thread, except for
/// wake().
class SocketCanSource {
 public:
  /// Opens the interface. Fails with kInvalidArgument for a setting out of its range, kNotFound if
  /// there is no such interface (unless waited for) or it is no CAN interface, kUnsupported if the
  /// kernel has no CAN, kUnreadable if the system refuses otherwise. An interface that is down is
  /// no error.
  [[nodiscard]] static Expected<SocketCanSource> open(SocketCanConfig config,
                                                      memory::FixedMemory& memory);

  /// Receives over any datagram socket that carries the kernel's frames (can_wire.hpp), one in each
  /// datagram, such as one end of a socket pair. `config.interface` is ignored: the descriptor is
  /// never replaced, and link() stays kUnknown.
  [[nodiscard]] static Expected<SocketCanSource> adopt(files::OwnedDescriptor descriptor,
                                                       SocketCanConfig config,
                                                       memory::FixedMemory& memory);

  /// Waits at most `timeout_ns` and returns [1, batch] data frames in order of arrival, or none if
  /// the time is up or wake() was called. The frames are valid until the next call. Error frames
  /// are counted, not returned.
  [[nodiscard]] std::span<const CanFrame> receive(std::int64_t timeout_ns) noexcept
      TERRACUT_NONBLOCKING;

  /// Ends the current receive(), or the next one that would wait, with an empty result. Any thread
  /// or a signal handler.
  void wake() const noexcept { wake_.wake(); }

  [[nodiscard]] const CanReceiveCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] net::LinkState link() const noexcept { return link_; }
  /// True if the controller has taken itself off the bus, as far as its error frames tell.
  [[nodiscard]] bool bus_off() const noexcept { return bus_off_; }

 private:
  /// Room for the control messages of a frame: its stamp and the kernel's count of drops.
  struct Control {
    static constexpr std::size_t kBytes =
        CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
    alignas(cmsghdr) std::array<std::uint8_t, kBytes> bytes;
  };
  using Wire = std::array<std::uint8_t, kFdWireBytes>;

  SocketCanSource(SocketCanConfig config, threads::WakeEvent wake, memory::FixedMemory& memory);

  [[nodiscard]] std::size_t read_batch() noexcept;
  [[nodiscard]] bool take(std::size_t slot, CanFrame& frame) noexcept;
  void note_error_frame(const CanFrame& frame) noexcept;
  void prepare(std::size_t slots) noexcept;
  void look_after_interface(std::int64_t now_ns) noexcept;

  SocketCanConfig config_;
  threads::WakeEvent wake_;
  /// An idle socket, used to ask the kernel about interfaces; empty if adopted.
  files::OwnedDescriptor probe_;
  files::OwnedDescriptor socket_;
  int interface_index_ = 0;

  std::span<Wire> wires_;
  std::span<::mmsghdr> messages_;
  std::span<::iovec> vectors_;
  std::span<Control> controls_;
  std::span<CanFrame> frames_;

  CanReceiveCounters counters_;
  net::DropCounter drops_;
  net::LinkState link_ = net::LinkState::kUnknown;
  bool bus_off_ = false;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace terracut::can
