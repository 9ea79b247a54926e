// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of packets of Hesai's models through a live run's whole chain; what the input bends of
// them: packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "any_hesai.hpp"
#include "calib/beams/beam_table.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hesai/stamp.hpp"
#include "packet_sequence.hpp"

namespace {

using namespace terracut;

template <class Model>
struct Hesai {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Column = fuzz::MadeColumn<Model::kChannels>;
  static constexpr const hesai::PacketLayout& kLayout = Model::kLayout;
  using Bytes = std::array<std::uint8_t, kLayout.packet_bytes()>;
  static constexpr int kColumns = kLayout.blocks;
  static constexpr std::size_t kReturnsAColumn = 6;

  static Calibration calibration() { return beams::built_in_table(Model::kModel); }
  static std::int64_t firing_ns(bool) { return kLayout.column_ns; }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading, (void)encoding;  // have no place in its packets
    Bytes bytes{};
    hesai::begin_packet(kLayout, dual, bytes);
    for (int block = 0; block < kLayout.blocks; ++block) {
      const Column& from = columns[static_cast<std::size_t>(block)];
      std::size_t at = kLayout.block_at(block);
      put(bytes, at + kLayout.azimuth_at(),
          static_cast<std::uint16_t>(beams::wrap_cdeg(from.unwrapped_azimuth_cdeg)));
      at += kLayout.returns_at();
      for (const auto& beam : from.by_laser) {
        put(bytes, at, beam.raw);
        bytes[at + 2] = beam.intensity;
        at += kLayout.return_bytes;
      }
    }
    hesai::write_stamp_us(kLayout, columns[0].stamp_ns / 1'000, bytes);
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    if (!hesai::is_of(kLayout, payload)) return 0;
    std::uint64_t returns = 0;
    for (int block = 0; block < kLayout.blocks; ++block) {
      std::size_t at = kLayout.block_at(block) + kLayout.returns_at();
      for (int laser = 0; laser < kLayout.lasers; ++laser, at += kLayout.return_bytes) {
        returns += payload[at] >= kLayout.least_count || payload[at + 1] != 0;
      }
    }
    return returns;
  }

 private:
  static void put(Bytes& bytes, std::size_t at, std::uint16_t value) {
    bytes[at] = static_cast<std::uint8_t>(value & 0xFF);
    bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  fuzz::with_any_hesai(input, [&]<class Model>(std::type_identity<Model>) {
    fuzz::PacketSequence<Hesai<Model>>(input).run();
  });
  return 0;
}
