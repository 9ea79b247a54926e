// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of RS-Ruby128 packets through a live run's whole chain; what the input bends of them:
// packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "calib/nominal_ruby128.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/packet_encoder.hpp"
#include "firmware_io/ruby128/ruby128_decoder.hpp"
#include "tests/fuzz/packet_sequence.hpp"

namespace {

using namespace terracut;

struct Ruby128 {
  using Decoder = firmware_io::Ruby128Decoder;
  using Calibration = calib::Ruby128Calibration;
  using Column = firmware_io::Ruby128Column;
  using Bytes = std::array<std::uint8_t, firmware_io::kRubyPacketBytes>;
  static constexpr int kColumns = firmware_io::kRubyBlocksPerPacket;
  static constexpr std::size_t kReturnsAColumn = 12;

  static Calibration calibration() { return calib::nominal_ruby128(); }
  static std::int64_t firing_ns(bool dual) {
    (void)dual;  // it fires alike
    return firmware_io::kRubyBlock_ns;
  }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    firmware_io::Ruby128PacketFacts facts;
    facts.returns = dual ? firmware_io::ReturnMode::kDual : firmware_io::ReturnMode::kSingle;
    facts.timestamp = static_cast<firmware_io::RubyTimestamp>(encoding);
    firmware_io::Ruby128PacketBuffer packet;
    firmware_io::encode_ruby128_packet(columns, static_cast<int>(first_reading % 2), facts, packet);
    Bytes bytes;
    std::ranges::copy(packet.payload(), bytes.begin());
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    const auto packet = firmware_io::Ruby128PacketView::of(payload);
    std::uint64_t sum = 0;
    for (int block = 0; packet && block < kColumns; ++block) {
      for (int channel = 0; channel < firmware_io::kRubyChannelsPerBlock; ++channel) {
        sum += packet->distance(block, channel) != 0;
      }
    }
    return sum;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  terracut::fuzz::Input input({data, size});
  terracut::fuzz::PacketSequence<Ruby128>(input).run();
  return 0;
}
