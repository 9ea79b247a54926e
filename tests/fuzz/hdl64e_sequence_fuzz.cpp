// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of HDL-64E packets through a live run's whole chain; what the input bends of them:
// packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "calib/nominal_hdl64e.hpp"
#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "firmware_io/hdl64e/packet_encoder.hpp"
#include "tests/fuzz/packet_sequence.hpp"

namespace {

using namespace terracut;

struct Hdl64e {
  using Decoder = firmware_io::Hdl64eDecoder;
  using Calibration = calib::Hdl64eCalibration;
  using Column = firmware_io::FiringColumn;
  using Bytes = std::array<std::uint8_t, firmware_io::kHdl64ePacketBytes>;
  static constexpr int kColumns = firmware_io::kColumnsPerPacketSingle;
  static constexpr std::size_t kReturnsAColumn = 6;

  static Calibration calibration() { return calib::nominal_hdl64e(); }
  static std::int64_t firing_ns(bool dual) {
    return dual ? firmware_io::kFiringTimesDual.packet_ns() / firmware_io::kColumnsPerPacketDual
                : firmware_io::kFiringTimesSingle48.packet_ns() / kColumns;
  }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading, (void)encoding;  // have no place in its packets
    firmware_io::Hdl64ePacketBuffer packet;
    const std::int64_t end_ns = columns.back().stamp_ns + firing_ns(dual);
    firmware_io::encode_hdl64e_packet(columns, end_ns, {}, packet);
    Bytes bytes;
    std::ranges::copy(packet.payload(), bytes.begin());
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    const auto packet = firmware_io::Hdl64ePacketView::of(payload);
    std::uint64_t sum = 0;
    for (int block = 0; packet && block < firmware_io::kBlocksPerPacket; ++block) {
      for (int j = 0; j < firmware_io::kLasersPerBlock; ++j) sum += packet->distance(block, j) != 0;
    }
    return sum;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  terracut::fuzz::Input input({data, size});
  terracut::fuzz::PacketSequence<Hdl64e>(input).run();
  return 0;
}
