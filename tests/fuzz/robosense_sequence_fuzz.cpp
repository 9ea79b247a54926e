// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of packets of RoboSenses with 32 lasers through a live run's whole chain; what the
// input bends of them: packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "any_robosense.hpp"
#include "calib/beams/beam_table.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "packet_sequence.hpp"

namespace {

using namespace terracut;

template <class Model>
struct RoboSense {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Column = fuzz::MadeColumn<Model::kChannels>;
  using Bytes = std::array<std::uint8_t, robosense::kPacketBytes>;
  static constexpr int kColumns = robosense::kBlocks;
  static constexpr std::size_t kReturnsAColumn = 6;

  static Calibration calibration() { return beams::built_in_table(Model::kModel); }
  static std::int64_t firing_ns(bool) { return Model::kLayout.column_ns; }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading, (void)dual;  // packets say neither
    Bytes bytes{};
    robosense::begin_packet(Model::kLayout, bytes);
    const auto stamp = ruby128::write_ruby_timestamp(columns[0].stamp_ns,
                                                     static_cast<ruby128::RubyTimestamp>(encoding));
    std::ranges::copy(stamp, bytes.begin() + robosense::kStampAt);
    for (int block = 0; block < kColumns; ++block) {
      const Column& from = columns[static_cast<std::size_t>(block)];
      std::size_t at = robosense::block_at(block);
      put(bytes, at + robosense::kAzimuthAt,
          static_cast<std::uint16_t>(beams::wrap_cdeg(from.unwrapped_azimuth_cdeg)));
      at += robosense::kReturnsAt;
      for (const auto& beam : from.by_laser) {
        put(bytes, at, beam.raw);
        bytes[at + 2] = beam.intensity;
        at += 3;
      }
    }
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    if (!robosense::is_of(Model::kLayout, payload)) return 0;
    std::uint64_t returns = 0;
    for (int block = 0; block < kColumns; ++block) {
      std::size_t at = robosense::block_at(block) + robosense::kReturnsAt;
      for (int laser = 0; laser < robosense::kLasers; ++laser, at += 3) {
        returns += payload[at] != 0 || payload[at + 1] != 0;
      }
    }
    return returns;
  }

 private:
  static void put(Bytes& bytes, std::size_t at, std::uint16_t value) {
    bytes[at] = static_cast<std::uint8_t>(value >> 8);
    bytes[at + 1] = static_cast<std::uint8_t>(value & 0xFF);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  fuzz::with_any_robosense(input, [&]<class Model>(std::type_identity<Model>) {
    fuzz::PacketSequence<RoboSense<Model>>(input).run();
  });
  return 0;
}
