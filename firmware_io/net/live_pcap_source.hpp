// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "firmware_io/net/drop_counter.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/wake_event.hpp"

struct pcap;  // libpcap's handle, pcap_t

namespace terracut::net {

struct LivePcapConfig {
  std::string interface{};
  std::optional<std::uint16_t> port{};  ///< UDP destination port.
  std::optional<Sender> sender{};       ///< The only sender accepted; others count as foreign.

  std::size_t batch = kBatchDatagrams;  ///< The most datagrams that receive() returns, > 0.
  std::size_t slot_bytes = 1536;        ///< The longest payload accepted, > 0.
};

/// Receives UDP datagrams on an interface with libpcap, where a socket does not get them: the
/// sensor sends to another machine's address, a firewall blocks them, or another program holds the
/// port. A DatagramSource (receive_counters.hpp); needs CAP_NET_RAW.
///
/// open() takes all memory. If the interface disappears, receive() returns nothing and tries twice
/// a second to open it again; only this allocates.
class LivePcapSource {
 public:
  /// Opens the interface. Fails with kNotFound if there is none of this name, kUnreadable if not
  /// permitted or the interface is down, kUnsupported for a link layer without IP.
  [[nodiscard]] static Expected<LivePcapSource> open(LivePcapConfig config,
                                                     memory::FixedMemory& memory);

  [[nodiscard]] std::span<const packet::Datagram> receive(std::int64_t timeout_ns) noexcept
      TERRACUT_NONBLOCKING;
  void wake() const noexcept { wake_.wake(); }

  /// Accepts only `sender` from now on; others count as foreign. To be called on the receiving
  /// thread.
  void accept_only(const Sender& sender) noexcept { config_.sender = sender; }

  /// Returns the counters. kernel_drops is that of the last refresh_drops(), which receive() calls
  /// after every full batch and when nothing came for a while.
  [[nodiscard]] const ReceiveCounters& counters() const noexcept { return counters_; }
  void refresh_drops() noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] LinkState link() const noexcept { return link_; }

 private:
  struct Close {
    void operator()(::pcap* handle) const noexcept;
  };
  using Handle = std::unique_ptr<::pcap, Close>;

  LivePcapSource(LivePcapConfig config, threads::WakeEvent wake, files::OwnedDescriptor probe,
                 memory::FixedMemory& memory);

  [[nodiscard]] static Expected<Handle> activate(const LivePcapConfig& config);
  void adopt(Handle handle) noexcept;

  [[nodiscard]] std::size_t read_batch() noexcept;
  void take(std::span<const std::uint8_t> frame,
            std::int64_t stamp_ns) noexcept TERRACUT_NONBLOCKING;
  void look_after(std::int64_t now_ns) noexcept;

  LivePcapConfig config_;
  threads::WakeEvent wake_;
  files::OwnedDescriptor probe_;  ///< An idle socket, used to ask the kernel about interfaces.
  Handle handle_;
  int descriptor_ = -1;  ///< Descriptor of the libpcap handle, to wait for.
  int link_type_ = 0;
  int interface_index_ = 0;
  std::int64_t stamp_unit_ns_ = 1;

  std::span<std::uint8_t> bytes_;
  std::span<packet::Datagram> datagrams_;
  std::size_t kept_ = 0;

  ReceiveCounters counters_;
  DropCounter drops_;
  LinkState link_ = LinkState::kUnknown;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace terracut::net
