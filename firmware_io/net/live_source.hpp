// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/net/live_pcap_source.hpp"
#include "firmware_io/net/udp_source.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// Where to listen for packets.
struct ListenConfig {
  Ipv4Endpoint at{.port = 2368};
  bool by_libpcap = false;  ///< True: listens with libpcap instead of a socket.
  std::string interface;    ///< Name of the interface; empty: any. libpcap needs one.
  std::optional<std::uint32_t> multicast_group;  ///< The multicast group to join; empty: none.
  bool share_port = false;
  std::optional<Sender> sender;  ///< The only sender accepted; others count as foreign.
  /// The longest payload accepted, > 0; the default is one Ethernet frame.
  std::size_t slot_bytes = 1536;
};

/// Receives live datagrams, by a socket or by libpcap. A DatagramSource
/// (firmware_io/net/receive_counters.hpp).
class LiveSource {
 public:
  /// Opens the source. Fails with kInvalidArgument for libpcap without an interface; otherwise as
  /// UdpSource::open() or LivePcapSource::open() does.
  [[nodiscard]] static Expected<LiveSource> open(const ListenConfig& config,
                                                 memory::FixedMemory& memory);

  [[nodiscard]] std::span<const packet::Datagram> receive(std::int64_t timeout_ns) noexcept
      TERRACUT_NONBLOCKING {
    if (udp_) return udp_->receive(timeout_ns);
    // libpcap is not marked nonblocking; it may wait here, as the thread waits for packets.
    return threads::trusted_call([&]() noexcept { return pcap_->receive(timeout_ns); });
  }
  void wake() const noexcept { udp_ ? udp_->wake() : pcap_->wake(); }
  [[nodiscard]] const ReceiveCounters& counters() const noexcept TERRACUT_NONBLOCKING {
    return udp_ ? udp_->counters() : pcap_->counters();
  }
  void refresh_drops() noexcept TERRACUT_NONBLOCKING {
    if (udp_) return udp_->refresh_drops();
    threads::trusted_call(
        [&]() noexcept { pcap_->refresh_drops(); });  // this only asks the kernel for a count
  }
  [[nodiscard]] LinkState link() const noexcept TERRACUT_NONBLOCKING {
    return udp_ ? udp_->link() : pcap_->link();
  }
  /// Returns roughly how many packets the system keeps until they are fetched.
  [[nodiscard]] std::size_t room_packets() const noexcept {
    constexpr std::size_t kOfLibpcap = 4096;  // the ring of libpcap has 8 MiB
    return udp_ ? udp_->room_packets() : kOfLibpcap;
  }
  /// Accepts only `sender` from now on; others count as foreign.
  void accept_only(const Sender& sender) noexcept {
    udp_ ? udp_->accept_only(sender) : pcap_->accept_only(sender);
  }

  /// Names the source for people: "0.0.0.0:2368", "port 2368 on eth0 by libpcap".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Lists requests to the system that were granted only in part.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  LiveSource() = default;

  [[nodiscard]] static Expected<LiveSource> open_socket(UdpSourceConfig config,
                                                        memory::FixedMemory& memory);
  [[nodiscard]] static Expected<LiveSource> open_pcap(LivePcapConfig config,
                                                      memory::FixedMemory& memory);

  std::optional<UdpSource> udp_;  ///< Set for a socket; otherwise the next member is set.
  std::optional<LivePcapSource> pcap_;
  std::string name_;
  std::vector<std::string> warnings_;
};
static_assert(DatagramSource<LiveSource>);

}  // namespace terracut::net
