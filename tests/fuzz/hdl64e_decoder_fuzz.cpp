// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The HDL-64E decoder on streams of packets made from the input: wild payloads, and well-formed
// packets whose stamps, azimuths and bytes the input bends. Whatever comes, every return of a
// packet that was accepted must be in a frame or counted as lost, and every packet that was not
// must be counted under its reason.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "decoder_run.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "input.hpp"

namespace {

using namespace terracut;

constexpr int kMaxPackets = 4'000;

std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
  const auto* packet = hdl64e::packet_in(payload);
  return packet == nullptr ? 0 : fuzz::returns_in(*packet);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  fuzz::DecoderRun<decode::Decoder, hdl64e::Hdl64eCalibration> run(hdl64e::nominal_hdl64e(),
                                                                   returns_in, 200.0F);
  hdl64e::wire::Packet packet = hdl64e::blank_packet();
  std::uint32_t azimuth_cdeg = input.next(2) % 36'000;
  std::uint32_t stamp_us = input.next(4);
  std::uint32_t step_cdeg = 17;
  bool is_s1 = false;
  const auto send = [&] {
    for (std::uint32_t block = 0; block < packet.blocks.size(); ++block) {
      const bool is_upper = is_s1 ? block % 4 != 0 : block % 2 == 0;
      packet.blocks[block].id = is_upper ? hdl64e::kUpperBlockId : hdl64e::kLowerBlockId;
      const std::uint32_t column = is_s1 ? block : block / 2;
      packet.blocks[block].azimuth_cdeg =
          static_cast<std::uint16_t>((azimuth_cdeg + column * step_cdeg) % 36'000);
    }
    packet.stamp_us = stamp_us;
    run.feed(hdl64e::payload_of(packet));
    azimuth_cdeg = (azimuth_cdeg + (is_s1 ? 12 : 6) * step_cdeg) % 36'000;
    stamp_us += 288;
    run.advance(288'000);
  };
  for (int fed = 0; fed < kMaxPackets && !input.empty(); ++fed) {
    switch (input.next(1) % 11) {
      case 0:  // the stream goes on
        send();
        break;
      case 1:  // for a while
        for (std::uint32_t n = input.next(1); n > 0; --n, ++fed) send();
        break;
      case 2:  // packets are lost, or the clock jumps
        stamp_us += input.next(4);
        break;
      case 3:
        azimuth_cdeg = input.next(2) % 36'000;
        break;
      case 4:  // an older packet, or a repeated one
        stamp_us -= 288 * (input.next(1) % 8);
        azimuth_cdeg = (azimuth_cdeg + 36'000 - 6 * step_cdeg * (input.next(1) % 8)) % 36'000;
        break;
      case 5:
        step_cdeg = input.next(1) % 120;
        break;
      case 6: {  // one return
        const std::uint32_t where = input.next(2);
        auto& one = packet.blocks[where / 32 % 12].returns[where % 32];
        one.distance = static_cast<std::uint16_t>(input.next(2));
        one.intensity = static_cast<std::uint8_t>(input.next(1));
        break;
      }
      case 7: {  // a bent copy of the packet
        std::array<std::uint8_t, hdl64e::kHdl64ePacketBytes> bent{};
        std::memcpy(bent.data(), hdl64e::payload_of(packet).data(), bent.size());
        for (std::uint32_t n = input.next(1) % 8; n > 0; --n) {
          bent[input.next(2) % bent.size()] = static_cast<std::uint8_t>(input.next(1));
        }
        run.feed(bent);
        break;
      }
      case 9:  // another generation
        is_s1 = !is_s1;
        break;
      case 8:  // anything
        run.feed(input.take(input.next(2) % 1'300));
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
