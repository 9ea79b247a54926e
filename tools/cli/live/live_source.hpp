// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "firmware_io/live/live_pcap_source.hpp"
#include "firmware_io/live/udp_source.hpp"
#include "live_options.hpp"

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

  [[nodiscard]] std::span<const firmware_io::Datagram> receive(std::int64_t timeout_ns) noexcept {
    return std::visit([&](auto& source) { return source.receive(timeout_ns); }, source_);
  }
  void wake() const noexcept {
    std::visit([](const auto& source) { source.wake(); }, source_);
  }
  [[nodiscard]] const firmware_io::ReceiveCounters& counters() const noexcept {
    return *std::visit([](const auto& source) { return &source.counters(); }, source_);
  }
  void refresh_drops() noexcept {
    std::visit([](auto& source) { source.refresh_drops(); }, source_);
  }
  [[nodiscard]] firmware_io::LinkState link() const noexcept {
    return std::visit([](const auto& source) { return source.link(); }, source_);
  }
  /// From now on only this sender; others count as foreign.
  void accept_only(std::uint32_t source_address) noexcept {
    std::visit([&](auto& source) { source.accept_only(source_address); }, source_);
  }

  /// For people: "0.0.0.0:2368", "port 2368 on eth0 by libpcap".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// What was asked for but could only be had in part.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  using Source = std::variant<firmware_io::UdpSource, firmware_io::LivePcapSource>;

  LiveSource(Source source, std::string name, std::vector<std::string> warnings)
      : source_(std::move(source)), name_(std::move(name)), warnings_(std::move(warnings)) {}

  [[nodiscard]] static Expected<LiveSource> open_socket(firmware_io::UdpSourceConfig config,
                                                        rt::FixedMemory& memory);
  [[nodiscard]] static Expected<LiveSource> open_pcap(firmware_io::LivePcapConfig config,
                                                      rt::FixedMemory& memory);

  Source source_;
  std::string name_;
  std::vector<std::string> warnings_;
};
static_assert(firmware_io::DatagramSource<LiveSource>);

}  // namespace terracut::cli
