// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of packets of Velodyne's models with a built-in table through a live run's whole chain;
// what the input bends of them: packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "any_velodyne.hpp"
#include "calib/beams/beam_table.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "packet_sequence.hpp"

namespace {

using namespace terracut;

template <class Model>
struct Velodyne {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Column = fuzz::MadeColumn<Model::kChannels>;
  using Bytes = std::array<std::uint8_t, velodyne::kPacketBytes>;
  static constexpr int kColumns = Model::kLayout.columns(false);
  static constexpr std::size_t kReturnsAColumn = 6;

  static Calibration calibration() { return beams::built_in_table(Model::kModel); }
  static std::int64_t firing_ns(bool) { return Model::kPace.column_ns; }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading, (void)encoding;  // have no place in its packets
    hdl64e::wire::Packet packet{};
    packet.stamp_us =
        static_cast<std::uint32_t>(columns[0].stamp_ns / 1'000 % velodyne::kClockWrap_us);
    packet.status_type = dual ? velodyne::kDual : velodyne::kStrongest;
    packet.status_value = sensor::row_of(Model::kModel).product_number;
    for (int column = 0; column < Model::kLayout.columns(dual); ++column) {
      const Column& from = columns[static_cast<std::size_t>(column)];
      for (int part = 0; part < Model::kLayout.blocks_per_column; ++part) {
        auto& block = packet.blocks[Model::kLayout.block(column, part, dual)];
        block.id = Model::kLayout.block_ids[static_cast<std::size_t>(part)];
        block.azimuth_cdeg =
            static_cast<std::uint16_t>(beams::wrap_cdeg(from.unwrapped_azimuth_cdeg));
        for (std::size_t i = 0; i < block.returns.size(); ++i) {
          const auto& beam = from.by_laser[static_cast<std::size_t>(part) * 32 + i];
          block.returns[i].distance = beam.raw;
          block.returns[i].intensity = beam.intensity;
        }
      }
    }
    Bytes bytes;
    std::ranges::copy(hdl64e::payload_of(packet), bytes.begin());
    return bytes;
  }
  /// The VLS-128's in dual return, which begins with two blocks of one id side by side, has nothing
  /// in its last four blocks.
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    const auto* packet = hdl64e::packet_in(payload);
    if (packet == nullptr) return 0;
    const bool has_empty_blocks = packet->status_type == velodyne::kDual &&
                                  packet->blocks[2].id.value() == hdl64e::kLowerBlockId;
    std::uint64_t returns = 0;
    for (std::size_t block = 0; block < (has_empty_blocks ? 8U : 12U); ++block) {
      for (const auto& one : packet->blocks[block].returns) returns += one.distance.value() != 0;
    }
    return returns;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  fuzz::with_any_velodyne(input, [&]<class Model>(std::type_identity<Model>) {
    fuzz::PacketSequence<Velodyne<Model>>(input).run();
  });
  return 0;
}
