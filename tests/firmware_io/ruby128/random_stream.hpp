// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/timestamp.hpp"

namespace terracut::test {

/// A rotating RS-Ruby128 that measures noise.
struct RubyStream {
  double spin_hz = 10;
  bool dual = false;
  double first_cdeg = 34'000, last_cdeg = 38'000;  ///< Of the head, unwrapped.
  double share_of_returns = 0.7;
  ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
  std::uint16_t protocol_version = 1;
  std::int64_t start_ns = 1'767'225'600'000'000'000 + 123'456'789;
  std::uint32_t seed = 1;
};

struct RubyPacket {
  ruby128::ruby128_wire::Packet bytes = ruby128::blank_packet();
  std::int64_t stamp_ns = 0;  ///< Of the first block.
  std::uint32_t returns = 0;

  [[nodiscard]] packet::Datagram datagram() const {
    return {.payload = ruby128::payload_of(bytes), .stamp_ns = stamp_ns};
  }
};

inline std::vector<RubyPacket> random_packets(const RubyStream& stream) {
  std::mt19937 random(stream.seed);
  std::uniform_real_distribution<double> chance(0, 1);
  std::uniform_int_distribution<unsigned> distance(100, 40'000), intensity(1, 255);
  const double step_cdeg = stream.spin_hz * beams::kRevolution_cdeg * ruby128::kRubyBlock_ns * 1e-9;
  std::vector<RubyPacket> packets;
  const int returns_a_firing = stream.dual ? 2 : 1;
  for (std::int64_t block = 0;; ++block) {
    const std::int64_t firing = block / returns_a_firing;
    const double rotor_cdeg = stream.first_cdeg + static_cast<double>(firing) * step_cdeg;
    const auto slot = static_cast<std::size_t>(block % ruby128::kRubyBlocksPerPacket);
    if (slot == 0) {
      if (rotor_cdeg >= stream.last_cdeg) return packets;
      RubyPacket& packet = packets.emplace_back();
      packet.stamp_ns = stream.start_ns + firing * ruby128::kRubyBlock_ns;
      packet.bytes.protocol_version = stream.protocol_version;
      packet.bytes.wave_mode = stream.dual ? 3 : 1;
      packet.bytes.stamp = ruby128::write_ruby_timestamp(packet.stamp_ns, stream.timestamp);
    }
    RubyPacket& packet = packets.back();
    packet.bytes.blocks[slot].azimuth_cdeg =
        static_cast<std::uint16_t>(beams::wrap_cdeg(std::llround(rotor_cdeg)));
    for (auto& beam : packet.bytes.blocks[slot].returns) {
      if (chance(random) >= stream.share_of_returns) continue;
      beam.intensity = static_cast<std::uint8_t>(intensity(random));
      beam.distance = static_cast<std::uint16_t>(distance(random));
      ++packet.returns;
    }
  }
}

}  // namespace terracut::test
