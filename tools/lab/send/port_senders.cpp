// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "port_senders.hpp"

#include <cerrno>

namespace terracut::send {

using send::UdpSender;

Expected<PortSenders> PortSenders::open(const std::string& to, UdpSenderConfig config,
                                        memory::FixedMemory& memory) {
  const bool has_port = to.find(':') != std::string::npos;
  const auto endpoint = net::parse_ipv4_endpoint(has_port ? to : to + ":0");
  if (!endpoint) return tl::unexpected(endpoint.error());
  if (has_port && endpoint->port == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "expected a port from 1 to 65535 after the address, found 0 in '" + to + "'");
  }
  config.to = *endpoint;
  // Opens a sender even if no port is known yet, so that a wrong address is reported now.
  UdpSenderConfig first = config;
  if (!has_port) first.to.port = 1;
  auto sender = UdpSender::open(first, memory);
  if (!sender) return tl::unexpected(sender.error());
  PortSenders senders(std::move(config), memory);
  if (has_port) senders.by_port_.emplace(std::uint16_t{0}, *std::move(sender));
  return senders;
}

UdpSender* PortSenders::sender_for(std::uint16_t port) {
  const std::uint16_t key = config_.to.port != 0 ? std::uint16_t{0} : port;
  auto found = by_port_.find(key);
  if (found == by_port_.end()) {
    UdpSenderConfig config = config_;
    config.to.port = port;
    auto opened = UdpSender::open(config, *memory_);
    if (!opened) {
      ++refused_;
      return nullptr;
    }
    found = by_port_.emplace(key, *std::move(opened)).first;
  }
  return &found->second;
}

SendCounters PortSenders::counters() const noexcept {
  SendCounters sum;
  sum.failed = refused_;
  if (refused_ > 0) sum.last_error = EMFILE;  // open() has reported all other errors
  for (const auto& [port, sender] : by_port_) sum += sender.counters();
  return sum;
}

std::string PortSenders::to() const {
  return config_.to.port != 0 ? to_string(config_.to) : net::ipv4_text(config_.to.address);
}

}  // namespace terracut::send
