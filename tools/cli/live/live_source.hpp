// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/live/live_pcap_source.hpp"
#include "firmware_io/live/udp_source.hpp"
#include "live_options.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::cli {

/// Where `terracut live` gets datagrams from: a socket, or libpcap. A DatagramSource
/// (firmware_io/live/receive_counters.hpp).
class LiveSource {
 public:
  /// As `options` say, but at `port` instead of theirs if one is given, and from `sender` alone if
  /// one is given. The errors of UdpSource::open() and LivePcapSource::open().
  [[nodiscard]] static Expected<LiveSource> open(const ListenOptions& options,
                                                 std::optional<std::uint16_t> port,
                                                 std::optional<std::uint32_t> sender,
                                                 rt::FixedMemory& memory);

  [[nodiscard]] std::span<const firmware_io::Datagram> receive(std::int64_t timeout_ns) noexcept
      TERRACUT_NONBLOCKING {
    if (udp_) return udp_->receive(timeout_ns);
    // The thread waits here for its work; what libpcap does for it, it does in code nobody marked.
    return rt::trusted_call([&]() noexcept { return pcap_->receive(timeout_ns); });
  }
  void wake() const noexcept { udp_ ? udp_->wake() : pcap_->wake(); }
  [[nodiscard]] const firmware_io::ReceiveCounters& counters() const noexcept TERRACUT_NONBLOCKING {
    return udp_ ? udp_->counters() : pcap_->counters();
  }
  void refresh_drops() noexcept TERRACUT_NONBLOCKING {
    if (udp_) return udp_->refresh_drops();
    rt::trusted_call([&]() noexcept { pcap_->refresh_drops(); });  // asks the kernel for a count
  }
  [[nodiscard]] firmware_io::LinkState link() const noexcept TERRACUT_NONBLOCKING {
    return udp_ ? udp_->link() : pcap_->link();
  }
  /// From now on only this sender; others count as foreign.
  void accept_only(std::uint32_t source_address) noexcept {
    udp_ ? udp_->accept_only(source_address) : pcap_->accept_only(source_address);
  }

  /// For people: "0.0.0.0:2368", "port 2368 on eth0 by libpcap".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// What was asked for but could only be had in part.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  LiveSource() = default;

  [[nodiscard]] static Expected<LiveSource> open_socket(firmware_io::UdpSourceConfig config,
                                                        rt::FixedMemory& memory);
  [[nodiscard]] static Expected<LiveSource> open_pcap(firmware_io::LivePcapConfig config,
                                                      rt::FixedMemory& memory);

  std::optional<firmware_io::UdpSource> udp_;        ///< This,
  std::optional<firmware_io::LivePcapSource> pcap_;  ///< or this.
  std::string name_;
  std::vector<std::string> warnings_;
};
static_assert(firmware_io::DatagramSource<LiveSource>);

}  // namespace terracut::cli
