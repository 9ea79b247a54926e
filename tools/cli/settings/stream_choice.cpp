// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stream_choice.hpp"

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/streams/stream_text.hpp"

namespace terracut::cli {

capture::CaptureFilter filter_of(const CaptureOptions& options) {
  capture::CaptureFilter filter{.port = options.port};
  if (const auto from = net::parse_ipv4_sender(options.from)) {
    filter.source_address = from->address;
    filter.source_port = from->port;
  }
  if (const auto to = net::parse_ipv4_address(options.to)) filter.destination_address = *to;
  if (const auto vlan = streams::parse_vlan(options.vlan)) filter.vlan = *vlan;
  if (const auto mac = streams::parse_mac(options.mac)) filter.source_mac = *mac;
  filter.topic = options.topic;
  return filter;
}

}  // namespace terracut::cli
