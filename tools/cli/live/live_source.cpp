// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/live/ipv4_endpoint.hpp"

namespace terracut::cli {

using firmware_io::LivePcapSource;
using firmware_io::UdpSource;

Expected<LiveSource> LiveSource::open(const ListenOptions& options,
                                      std::optional<std::uint16_t> port,
                                      std::optional<std::uint32_t> sender,
                                      rt::FixedMemory& memory) {
  auto at = firmware_io::parse_ipv4_endpoint(options.address);
  if (!at) return tl::unexpected(at.error());
  at->port = port.value_or(at->port);
  if (options.via == "libpcap") {
    return open_pcap({.interface = options.interface, .port = at->port, .source_address = sender},
                     memory);
  }
  firmware_io::UdpSourceConfig config{.bind = *at,
                                      .interface = options.interface,
                                      .source_address = sender,
                                      .share_port = options.share_port};
  if (!options.multicast.empty()) {
    const auto group = firmware_io::parse_ipv4_address(options.multicast);
    if (!group) return tl::unexpected(group.error());
    config.multicast_group = *group;
  }
  return open_socket(std::move(config), memory);
}

Expected<LiveSource> LiveSource::open_socket(firmware_io::UdpSourceConfig config,
                                             rt::FixedMemory& memory) {
  auto source = UdpSource::open(std::move(config), memory);
  if (!source) return tl::unexpected(source.error());
  LiveSource opened;
  opened.name_ = to_string(source->local());
  opened.warnings_.assign(source->warnings().begin(), source->warnings().end());
  opened.udp_ = *std::move(source);
  return opened;
}

Expected<LiveSource> LiveSource::open_pcap(firmware_io::LivePcapConfig config,
                                           rt::FixedMemory& memory) {
  if (config.interface.empty()) {
    return fail(ErrorCode::kInvalidArgument, "--via libpcap needs --interface: where to listen");
  }
  LiveSource opened;
  opened.name_ = fmt::format("port {} on {} by libpcap", *config.port, config.interface);
  auto source = LivePcapSource::open(std::move(config), memory);
  if (!source) return tl::unexpected(source.error());
  opened.pcap_ = *std::move(source);
  return opened;
}

}  // namespace terracut::cli
