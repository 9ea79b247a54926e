// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/live_source.hpp"

#include <fmt/format.h>

#include <utility>

namespace terracut::net {

Expected<LiveSource> LiveSource::open(const ListenConfig& config, memory::FixedMemory& memory) {
  if (config.by_libpcap) {
    return open_pcap({.interface = config.interface,
                      .port = config.at.port,
                      .sender = config.sender,
                      .slot_bytes = config.slot_bytes},
                     memory);
  }
  return open_socket({.bind = config.at,
                      .multicast_group = config.multicast_group,
                      .interface = config.interface,
                      .sender = config.sender,
                      .share_port = config.share_port,
                      .slot_bytes = config.slot_bytes},
                     memory);
}

Expected<LiveSource> LiveSource::open_socket(UdpSourceConfig config, memory::FixedMemory& memory) {
  auto source = UdpSource::open(std::move(config), memory);
  if (!source) return tl::unexpected(source.error());
  LiveSource opened;
  opened.name_ = to_string(source->local());
  opened.warnings_.assign(source->warnings().begin(), source->warnings().end());
  opened.udp_ = *std::move(source);
  return opened;
}

Expected<LiveSource> LiveSource::open_pcap(LivePcapConfig config, memory::FixedMemory& memory) {
  if (config.interface.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "listening by libpcap (--via libpcap) needs an interface (--interface)");
  }
  LiveSource opened;
  opened.name_ = fmt::format("port {} on {} by libpcap", *config.port, config.interface);
  auto source = LivePcapSource::open(std::move(config), memory);
  if (!source) return tl::unexpected(source.error());
  opened.pcap_ = *std::move(source);
  return opened;
}

}  // namespace terracut::net
