// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The RS-Ruby128 decoder on streams of packets made from the input: wild payloads, and well-formed
// packets in single and dual return whose stamps, of any encoding, azimuths and bytes the input
// bends. What must hold: tests/fuzz/decoder_run.hpp.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "decoder_run.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "input.hpp"

namespace {

using namespace terracut;

constexpr int kMaxPackets = 4'000;

std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
  const auto* packet = ruby128::packet_in(payload);
  return packet == nullptr ? 0 : fuzz::returns_in(*packet);
}

/// A head whose azimuth, speed, clock and return mode the input changes at will.
struct Head {
  std::uint32_t azimuth_cdeg = 0, step_cdeg = 20;
  std::int64_t stamp_ns = 1'767'225'600'000'000'000;
  ruby128::RubyTimestamp encoding = ruby128::RubyTimestamp::kUtcMicroseconds;
  std::uint32_t reading = 0, readings_per_firing = 1;

  void next(ruby128::ruby128_wire::Packet& packet) {
    packet.stamp = ruby128::write_ruby_timestamp(stamp_ns, encoding);
    for (ruby128::ruby128_wire::Block& block : packet.blocks) {
      block.azimuth_cdeg = static_cast<std::uint16_t>(azimuth_cdeg);
      if (++reading % readings_per_firing != 0) continue;
      azimuth_cdeg = (azimuth_cdeg + step_cdeg) % 36'000;
      stamp_ns += ruby128::kRubyBlock_ns;
    }
  }
  void go_back(std::uint32_t firings) {
    azimuth_cdeg = (azimuth_cdeg + 36'000 - firings * step_cdeg % 36'000) % 36'000;
    stamp_ns -= std::int64_t{firings} * ruby128::kRubyBlock_ns;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  fuzz::DecoderRun<decode::Decoder, ruby128::Ruby128Calibration> run(ruby128::nominal_ruby128(),
                                                                     returns_in, 400.0F);
  ruby128::ruby128_wire::Packet packet = ruby128::blank_packet();
  Head head;
  const auto send = [&] {
    const std::int64_t before_ns = head.stamp_ns;
    head.next(packet);
    run.feed(ruby128::payload_of(packet));
    run.advance(head.stamp_ns - before_ns);
  };
  for (int fed = 0; fed < kMaxPackets && !input.empty(); ++fed) {
    switch (input.below(12)) {
      case 0:  // the stream goes on
        send();
        break;
      case 1:  // for a while
        for (std::uint32_t n = input.next(1); n > 0; --n, ++fed) send();
        break;
      case 2:  // packets are lost, or the clock jumps
        head.stamp_ns += std::int64_t{input.next(4)} * (input.next(1) % 2 == 0 ? 1'000 : 1);
        break;
      case 3:
        head.azimuth_cdeg = input.next(2) % 36'000;
        break;
      case 4:  // an older packet, or a repeated one
        head.go_back(3 * (input.next(1) % 8));
        break;
      case 5:
        head.step_cdeg = input.next(1) % 120;
        break;
      case 6: {  // one return
        const auto block = static_cast<std::size_t>(input.below(ruby128::kRubyBlocksPerPacket));
        const auto channel = static_cast<std::size_t>(input.below(ruby128::kRubyChannelsPerBlock));
        auto& one = packet.blocks[block].returns[channel];
        one.distance = static_cast<std::uint16_t>(input.next(2));
        one.intensity = static_cast<std::uint8_t>(input.next(1));
        break;
      }
      case 7: {  // a bent copy of the packet
        std::array<std::uint8_t, ruby128::kRubyPacketBytes> bent{};
        std::memcpy(bent.data(), ruby128::payload_of(packet).data(), bent.size());
        for (std::uint32_t n = input.next(1) % 8; n > 0; --n) {
          bent[input.next(2) % bent.size()] = static_cast<std::uint8_t>(input.next(1));
        }
        run.feed(bent);
        break;
      }
      case 8:  // anything
        run.feed(input.take(input.next(2) % 1'300));
        break;
      case 9:  // single or dual return, from either block of a pair on
        head.readings_per_firing = 1 + input.next(1) % 2;
        head.reading += input.next(1) % 2;
        break;
      case 10:
        head.encoding = static_cast<ruby128::RubyTimestamp>(input.next(1) % 3);
        packet.protocol_version = static_cast<std::uint16_t>(input.next(1) % 2);
        break;
      default:
        run.advance(static_cast<std::int32_t>(input.next(4)));
        if (input.next(1) % 4 == 0) run.flush();
        break;
    }
  }
  run.flush();
  run.check();
  return 0;
}
