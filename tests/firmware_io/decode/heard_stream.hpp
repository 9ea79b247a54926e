// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::test {

using reference::Payload;

/// Payload number `n` of a head that rotates steadily from 340 degrees on, or any part of it.
template <class Sensor>
struct Head {
  double spin_hz = 10;
  bool dual_return = false;
  double share_of_returns = 0.3;

  [[nodiscard]] std::vector<Payload> frames(double count) const {
    const double packet_s =
        Sensor::firing_us(dual_return) * Sensor::firings_per_packet(dual_return) * 1e-6;
    return Sensor::payloads({.spin_hz = spin_hz,
                             .dual_return = dual_return,
                             .packets = static_cast<int>(count / (spin_hz * packet_s)),
                             .share_of_returns = share_of_returns});
  }
  /// One packet of a head that stands at `rotor_deg`, by the device's clock at `stamp_ns`.
  [[nodiscard]] Payload packet(double rotor_deg, std::int64_t stamp_ns) const {
    Payload payload = Sensor::payloads({.spin_hz = spin_hz,
                                        .dual_return = dual_return,
                                        .first_deg = std::fmod(rotor_deg, 360.0),
                                        .packets = 1,
                                        .share_of_returns = share_of_returns})[0];
    payload.stamp_ns = stamp_ns;
    Sensor::set_clock(payload.bytes, stamp_ns);
    return payload;
  }
};

template <class Sensor>
std::uint64_t returns_in(const Payload& payload) {
  std::uint64_t returns = 0;
  for (int block = 0; block < Sensor::kBlocks; ++block) {
    const int first = Sensor::kFirstBlock + block * Sensor::kBlockBytes + 4;
    for (int at = first; at < first + Sensor::kBlockBytes - 4; at += 3) {
      const auto byte = static_cast<std::size_t>(at);
      returns += payload.bytes[byte] != 0 || payload.bytes[byte + 1] != 0 ? 1U : 0U;
    }
  }
  return returns;
}

/// A decoder of any unit and all that came out of it.
template <class Sensor>
class HeardStream {
 public:
  using Config = typename Sensor::Decoder::Config;
  static Config hasty() {
    Config config;
    config.reorder_packets = 0;  // as live does
    return config;
  }

  explicit HeardStream(const Config& config = {}) : decoder(unit(), {}, config, memory_) {}
  /// Of a stream that has ended.
  explicit HeardStream(const std::vector<Payload>& payloads, const Config& config = {})
      : HeardStream(config) {
    hear_all(payloads);
    flush();
  }

  std::optional<frame::Reject> hear(const Payload& payload) {
    ++fed;
    const std::size_t frames_before = frames.size();
    const std::uint64_t decoded_before = decoder.packets_decoded();
    const std::uint64_t rejected_before = decoder.losses().rejected_total();
    const auto reason = test::decode(
        decoder, packet::Datagram{.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, keep());
    expect_bounded_work(frames.size() - frames_before, decoder.packets_decoded() - decoded_before,
                        decoder.losses().rejected_total() - rejected_before);
    if (!reason) returns_taken += returns_in<Sensor>(payload);
    return reason;
  }
  void hear_all(const std::vector<Payload>& payloads) {
    for (const Payload& payload : payloads) (void)hear(payload);
  }
  void flush() { test::end_stream(decoder, keep()); }

  [[nodiscard]] std::uint64_t rejected(frame::Reject reason) const {
    return decoder.losses().rejected[static_cast<std::size_t>(reason)];
  }
  /// What was fed and is neither decoded nor rejected under a name.
  [[nodiscard]] std::int64_t packets_unaccounted() const {
    return static_cast<std::int64_t>(fed - decoder.packets_decoded() -
                                     decoder.losses().rejected_total());
  }
  /// Returns of decoded packets that are neither in a frame nor counted; after flush().
  [[nodiscard]] std::int64_t returns_unaccounted() const {
    return static_cast<std::int64_t>(returns_taken - returns_handed_over -
                                     decoder.losses().overflow_full_returns -
                                     decoder.losses().late_returns);
  }

  std::uint64_t fed = 0, returns_taken = 0, returns_handed_over = 0;
  std::vector<frame::FrameInfo> frames;

 private:
  static typename Sensor::Calibration unit() {
    std::mt19937 random(1);
    return Sensor::random_unit(random);
  }
  /// "Work per packet" of docs/design.md: a packet ends the two open frames and, behind a gap, the
  /// one that it lies at the end of. One may bear out 31 others that were in doubt, of which those
  /// from frames before the last are rejected; then two end within the frame in doubt.
  static void expect_bounded_work(std::size_t frames, std::uint64_t decoded,
                                  std::uint64_t rejected) {
    EXPECT_LE(decoded, 32U);
    EXPECT_LE(frames, decoded + rejected <= 1 ? 3U : 4U);
  }
  [[nodiscard]] auto keep() {
    return [this](const frame::FrameInfo& info, const frame::MeasuredReturns& returns) noexcept {
      frames.push_back(info);
      returns_handed_over += returns.returns();
    };
  }

  memory::FixedMemory memory_;

 public:
  typename Sensor::Decoder decoder;
};

}  // namespace terracut::test
