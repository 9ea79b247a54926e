// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Datagrams to send and a patient way to receive them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "firmware_io/net/udp_source.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/lab/send/udp_sender.hpp"

namespace terracut::test {

inline constexpr std::uint32_t kLocalhost = 0x7F000001;       ///< 127.0.0.1
inline constexpr std::uint32_t kOtherLocalhost = 0x7F000002;  ///< 127.0.0.2, local as well.

/// Datagrams whose payload begins with their number.
class Numbered {
 public:
  explicit Numbered(std::size_t count, std::size_t bytes = 1206, std::uint64_t first = 0) {
    payloads_.assign(count, std::vector<std::uint8_t>(bytes));
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t number = first + i;
      std::memcpy(payloads_[i].data(), &number, sizeof number);
      datagrams_.push_back({.payload = payloads_[i]});
    }
  }
  [[nodiscard]] std::vector<packet::Datagram>& datagrams() { return datagrams_; }

 private:
  std::vector<std::vector<std::uint8_t>> payloads_;
  std::vector<packet::Datagram> datagrams_;
};

[[nodiscard]] inline std::uint64_t number_of(const packet::Datagram& datagram) {
  std::uint64_t number = 0;
  std::memcpy(&number, datagram.payload.data(), sizeof number);
  return number;
}

/// A datagram that was received, with its bytes.
struct Received {
  packet::Datagram datagram;
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::uint64_t number() const { return number_of({.payload = bytes}); }
};

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// So long is waited for what must come, on the slowest machine.
inline constexpr std::int64_t kPatience_ns = 200'000 * kMillisecond_ns;

inline void keep(std::span<const packet::Datagram> batch, std::vector<Received>& received) {
  for (const packet::Datagram& each : batch) {
    received.push_back({each, {each.payload.begin(), each.payload.end()}});
  }
}

/// Receives until `done()`; false when that did not come about in kPatience_ns.
template <class Source, class Done>
[[nodiscard]] bool receive_until(Source& source, std::vector<Received>& received, Done&& done) {
  const std::int64_t deadline_ns = measure::monotonic_ns() + kPatience_ns;
  while (!done()) {
    if (measure::monotonic_ns() > deadline_ns) return false;
    keep(source.receive(20 * kMillisecond_ns), received);
  }
  return true;
}

/// The next `count` datagrams, or fewer when they do not come.
template <class Source>
[[nodiscard]] std::vector<Received> receive(Source& source, std::size_t count) {
  std::vector<Received> received;
  EXPECT_TRUE(receive_until(source, received, [&] { return received.size() >= count; }))
      << received.size() << " of " << count << " datagrams came";
  return received;
}

[[nodiscard]] inline std::vector<std::uint64_t> numbers_of(const std::vector<Received>& received) {
  std::vector<std::uint64_t> numbers;
  for (const Received& each : received) numbers.push_back(each.number());
  return numbers;
}

/// A source on a free port of this machine and a sender to it.
class LiveTest : public testing::Test {
 protected:
  /// With the receive buffer that any system grants, unless the test asks for another: it holds
  /// about 170 datagrams of 1.2 kB.
  [[nodiscard]] net::UdpSource open(net::UdpSourceConfig config = {}) {
    const net::UdpSourceConfig usual;
    if (config.receive_buffer_bytes == usual.receive_buffer_bytes) {
      config.receive_buffer_bytes = 200'000;
    }
    auto source = net::UdpSource::open(std::move(config), memory_);
    if (!source) throw std::runtime_error(source.error().message);
    return *std::move(source);
  }
  [[nodiscard]] send::UdpSender sender_to(const net::UdpSource& source,
                                          std::uint32_t from = kLocalhost) {
    return make_sender(
        {.to = {kLocalhost, source.local().port}, .from = net::Ipv4Endpoint{from, 0}});
  }
  [[nodiscard]] send::UdpSender make_sender(const send::UdpSenderConfig& config) {
    auto sender = send::UdpSender::open(config, memory_);
    if (!sender) throw std::runtime_error(sender.error().message);
    return *std::move(sender);
  }

  memory::FixedMemory memory_;
};

}  // namespace terracut::test
