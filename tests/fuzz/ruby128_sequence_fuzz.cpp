// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of RS-Ruby128 packets through a live run's whole chain; what the input bends of them:
// packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "packet_sequence.hpp"
#include "tools/lab/packets/ruby128_packet_encoder.hpp"

namespace {

using namespace terracut;

struct Ruby128 {
  using Decoder = decode::Decoder;
  using Calibration = ruby128::Ruby128Calibration;
  using Column = packets::Ruby128Column;
  using Bytes = std::array<std::uint8_t, ruby128::kRubyPacketBytes>;
  static constexpr int kColumns = ruby128::kRubyBlocksPerPacket;
  static constexpr std::size_t kReturnsAColumn = 12;

  static Calibration calibration() { return ruby128::nominal_ruby128(); }
  static std::int64_t firing_ns(bool dual) {
    (void)dual;  // it fires alike
    return ruby128::kRubyBlock_ns;
  }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    packets::Ruby128PacketFacts facts;
    facts.returns = dual ? packets::ReturnMode::kDual : packets::ReturnMode::kSingle;
    facts.timestamp = static_cast<ruby128::RubyTimestamp>(encoding);
    ruby128::ruby128_wire::Packet packet = ruby128::blank_packet();
    packets::encode_ruby128_packet(columns, static_cast<int>(first_reading % 2), facts, packet);
    Bytes bytes;
    std::ranges::copy(ruby128::payload_of(packet), bytes.begin());
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    const auto* packet = ruby128::packet_in(payload);
    return packet == nullptr ? 0 : fuzz::returns_in(*packet);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  terracut::fuzz::Input input({data, size});
  terracut::fuzz::PacketSequence<Ruby128>(input).run();
  return 0;
}
