// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <ctime>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/net/drop_counter.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/net/network_interface.hpp"
#include "firmware_io/net/receive_buffer.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::net {

struct UdpSourceConfig {
  /// The address and port that the sensor sends to. Leave the address 0 unless only one of this
  /// machine's addresses is to be used: a socket bound to an address gets no broadcasts, and an
  /// HDL-64E broadcasts until configured otherwise. With port 0 the system chooses a port (see
  /// UdpSource::local()).
  Ipv4Endpoint bind{};
  /// The multicast group to join: on `interface` if that is set, else on the interface that the
  /// routing table names.
  std::optional<std::uint32_t> multicast_group{};
  std::string interface{};         ///< The only interface to receive on; empty: any.
  std::optional<Sender> sender{};  ///< The only sender accepted; others count as foreign.
  /// Lets other sockets with the same option bind the port as well. Each then gets a copy of
  /// broadcasts and multicasts; a datagram to one address goes to only one of them.
  bool share_port = false;

  std::size_t receive_buffer_bytes = 8U << 20;  ///< About 7000 packets: 1.2 s of a Ruby128.
  std::size_t batch = kBatchDatagrams;          ///< The most datagrams that receive() returns, > 0.
  std::size_t slot_bytes = 1536;  ///< The longest payload accepted, > 0; one Ethernet frame.
};

/// Receives UDP datagrams over IPv4, many with one system call, with the kernel's time stamps and
/// its count of drops. A DatagramSource (receive_counters.hpp).
///
/// open() takes all memory; receive() never allocates, throws or waits longer than told. If an
/// interface goes down, or disappears and comes back under its name, receive() returns nothing,
/// looks for the interface twice a second, opens the socket again when possible, and counts.
class UdpSource {
 public:
  /// Opens the socket. Fails with kInvalidArgument for a setting out of its range; kNotFound if
  /// there is no such interface, or the address is not this machine's; kUnreadable if the port is
  /// taken or not allowed, or the system refuses otherwise. The message says how to mend it.
  [[nodiscard]] static Expected<UdpSource> open(UdpSourceConfig config,
                                                memory::FixedMemory& memory);

  [[nodiscard]] std::span<const packet::Datagram> receive(std::int64_t timeout_ns) noexcept
      TERRACUT_NONBLOCKING;
  void wake() const noexcept { wake_.wake(); }

  /// Accepts only `sender` from now on; others count as foreign. To be called on the receiving
  /// thread.
  void accept_only(const Sender& sender) noexcept { config_.sender = sender; }

  /// Returns the counters. kernel_drops is that of the newest datagram or of the last
  /// refresh_drops(), which asks the kernel; receive() calls this after every full batch and when
  /// nothing comes for a while.
  [[nodiscard]] const ReceiveCounters& counters() const noexcept { return counters_; }
  void refresh_drops() noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] LinkState link() const noexcept { return link_; }
  /// Returns roughly how many packets the kernel keeps until they are fetched.
  [[nodiscard]] std::size_t room_packets() const noexcept { return socket_.buffer.packets(); }

  /// Returns the address and port that the socket is bound to; the port is the one chosen by the
  /// system.
  [[nodiscard]] const Ipv4Endpoint& local() const noexcept { return config_.bind; }
  /// Lists requests to the system that were granted only in part, one sentence each, for the log at
  /// start.
  [[nodiscard]] std::span<const std::string> warnings() const noexcept { return warnings_; }

 private:
  struct Socket {
    files::OwnedDescriptor descriptor;
    ReceiveBuffer buffer;
    int interface_index = 0;
    bool bound_to_interface = false;  ///< If false, the interface is checked for each datagram.
  };

  /// Which system call in open_socket() failed, and its errno.
  enum class Step : std::uint8_t { kSocket, kInterface, kBind, kJoin };
  struct Failure {
    Step step;
    int error_number;
  };

  /// Room for the control messages of a datagram: its stamp, the count of drops, and its interface.
  struct Control {
    static constexpr std::size_t kBytes = CMSG_SPACE(sizeof(timespec)) +
                                          CMSG_SPACE(sizeof(std::uint32_t)) +
                                          CMSG_SPACE(sizeof(in_pktinfo));
    alignas(cmsghdr) std::array<std::uint8_t, kBytes> bytes;
  };

  UdpSource(UdpSourceConfig config, threads::WakeEvent wake, files::OwnedDescriptor probe,
            memory::FixedMemory& memory);

  /// Opens a socket without allocating memory, so that receive() may do this again.
  [[nodiscard]] static tl::expected<Socket, Failure> open_socket(
      const UdpSourceConfig& config, const InterfaceStatus& interface) noexcept;
  [[nodiscard]] static Error explain(const UdpSourceConfig& config, const Failure& failure);
  void note_shortfalls();

  [[nodiscard]] std::size_t read_batch() noexcept;
  [[nodiscard]] bool take(std::size_t slot, packet::Datagram& datagram) noexcept;
  void prepare(std::size_t slots) noexcept;
  void look_after(std::int64_t now_ns) noexcept;
  void look_after_interface() noexcept;

  UdpSourceConfig config_;
  threads::WakeEvent wake_;
  files::OwnedDescriptor probe_;  ///< An idle socket, used to ask the kernel about interfaces.
  Socket socket_;
  std::vector<std::string> warnings_;

  std::span<std::uint8_t> bytes_;
  std::span<::mmsghdr> messages_;
  std::span<::iovec> vectors_;
  std::span<::sockaddr_in> senders_;
  std::span<Control> controls_;
  std::span<packet::Datagram> datagrams_;

  ReceiveCounters counters_;
  DropCounter drops_;
  LinkState link_ = LinkState::kUnknown;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace terracut::net
