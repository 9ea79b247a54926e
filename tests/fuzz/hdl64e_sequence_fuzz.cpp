// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of HDL-64E packets through a live run's whole chain; what the input bends of them:
// packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"
#include "packet_sequence.hpp"
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"

namespace {

using namespace terracut;

struct Hdl64e {
  using Decoder = decode::Decoder;
  using Calibration = hdl64e::Hdl64eCalibration;
  using Column = packets::FiringColumn;
  using Bytes = std::array<std::uint8_t, hdl64e::kHdl64ePacketBytes>;
  static constexpr int kColumns = hdl64e::kColumnsPerPacketSingle;
  static constexpr std::size_t kReturnsAColumn = 6;

  static Calibration calibration() { return hdl64e::nominal_hdl64e(); }
  static std::int64_t firing_ns(bool dual) {
    return dual ? hdl64e::kFiringTimesDual.packet_ns() / hdl64e::kColumnsPerPacketDual
                : hdl64e::kFiringTimesSingle48.packet_ns() / kColumns;
  }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading;  // has no place in its packets
    hdl64e::wire::Packet packet = hdl64e::blank_packet();
    const std::int64_t end_ns = columns.back().stamp_ns + firing_ns(dual);
    packets::encode_hdl64e_packet(columns, end_ns, {}, packet);
    if (encoding == 2) make_s1(packet);
    Bytes bytes;
    std::ranges::copy(hdl64e::payload_of(packet), bytes.begin());
    return bytes;
  }
  /// A block a firing, the upper lasers three times as often.
  static void make_s1(hdl64e::wire::Packet& packet) {
    const std::int32_t first_cdeg = packet.blocks[0].azimuth_cdeg.value();
    const std::int32_t step_cdeg =
        beams::step_cdeg(first_cdeg, packet.blocks[2].azimuth_cdeg.value());
    for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
      packet.blocks[block].id = block % 4 != 0 ? hdl64e::kUpperBlockId : hdl64e::kLowerBlockId;
      packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(
          beams::wrap_cdeg(first_cdeg + static_cast<std::int32_t>(block) * step_cdeg / 2));
    }
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    const auto* packet = hdl64e::packet_in(payload);
    return packet == nullptr ? 0 : fuzz::returns_in(*packet);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  terracut::fuzz::Input input({data, size});
  terracut::fuzz::PacketSequence<Hdl64e>(input).run();
  return 0;
}
