// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The decoders of Velodyne's models with a built-in table, on streams of packets made from the
// input: wild payloads, and well-formed packets in single and dual return whose stamps, azimuths
// and bytes the input bends. What must hold: tests/fuzz/decoder_run.hpp.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "calib/velodyne/velodyne_calibration.hpp"
#include "decoder_run.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "input.hpp"
#include "velodyne_returns.hpp"

namespace {

using namespace terracut;

constexpr int kMaxPackets = 4'000;

struct Model {
  velodyne::VelodyneModel model;
  velodyne::PacketLayout layout;
  std::uint8_t product;
};
constexpr std::array kModels{
    Model{velodyne::VelodyneModel::kVlp16, velodyne::Vlp16::kLayout, 0x22},
    Model{velodyne::VelodyneModel::kHdl32e, velodyne::Hdl32e::kLayout, 0x21},
    Model{velodyne::VelodyneModel::kVlp32c, velodyne::Vlp32c::kLayout, 0x28},
    Model{velodyne::VelodyneModel::kVls128, velodyne::Vls128::kLayout, 0xA1},
};

/// A head whose azimuth, speed, clock and return mode the input changes at will.
struct Head {
  const Model& model;
  std::uint32_t azimuth_cdeg = 0, step_cdeg = 40;
  std::int64_t stamp_ns = 1'000'000'000;
  bool dual_return = false;
  std::uint32_t sector_at = 0, sector_cdeg = 0;  ///< A jump before that column.

  void next(hdl64e::wire::Packet& packet) {
    packet.stamp_us = static_cast<std::uint32_t>(stamp_ns / 1000 % hdl64e::kDeviceHour_us);
    packet.status_type = dual_return ? velodyne::kDual : velodyne::kStrongest;
    packet.status_value = model.product;
    for (int column = 0; column < model.layout.columns(dual_return); ++column) {
      const bool is_first = !dual_return || column % 2 == 0;
      if (column > 0 && is_first) go_on(1);
      if (sector_at > 0 && column == static_cast<int>(sector_at) && is_first) {
        azimuth_cdeg = (azimuth_cdeg + sector_cdeg) % 36'000;
      }
      for (int part = 0; part < model.layout.blocks_per_column; ++part) {
        auto& block = packet.blocks[model.layout.block(column, part, dual_return)];
        block.id = model.layout.block_ids[static_cast<std::size_t>(part)];
        block.azimuth_cdeg = static_cast<std::uint16_t>(azimuth_cdeg);
      }
    }
    go_on(1);
    sector_at = 0;
  }
  void go_on(std::int64_t firings) {
    azimuth_cdeg =
        static_cast<std::uint32_t>((azimuth_cdeg + 36'000 + firings * step_cdeg % 36'000) % 36'000);
    stamp_ns += firings * model.layout.column_ns;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  Head head{kModels[input.next(1) % kModels.size()]};
  fuzz::DecoderRun<decode::Decoder, velodyne::VelodyneCalibration> run(
      velodyne::factory_table(head.model.model), fuzz::velodyne_returns_in, 400.0F);
  hdl64e::wire::Packet packet{};
  const auto send = [&] {
    const std::int64_t before_ns = head.stamp_ns;
    head.next(packet);
    run.feed(hdl64e::payload_of(packet));
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
        head.stamp_ns += std::int64_t{input.next(4)} * 1'000;
        break;
      case 3:
        head.azimuth_cdeg = input.next(2) % 36'000;
        break;
      case 4:  // an older packet, or a repeated one
        head.go_on(-12 * static_cast<std::int64_t>(input.next(1) % 8));
        break;
      case 5:
        head.step_cdeg = input.next(1) % 140;
        break;
      case 6: {  // one return
        const std::uint32_t where = input.next(2);
        auto& one = packet.blocks[where / 32 % 12].returns[where % 32];
        one.distance = static_cast<std::uint16_t>(input.next(2));
        one.intensity = static_cast<std::uint8_t>(input.next(1));
        break;
      }
      case 7: {  // a bent copy of the packet
        std::array<std::uint8_t, velodyne::kPacketBytes> bent{};
        std::memcpy(bent.data(), hdl64e::payload_of(packet).data(), bent.size());
        for (std::uint32_t n = input.next(1) % 8; n > 0; --n) {
          bent[input.next(2) % bent.size()] = static_cast<std::uint8_t>(input.next(1));
        }
        run.feed(bent);
        break;
      }
      case 8:  // anything
        run.feed(input.take(input.next(2) % 1'300));
        break;
      case 9:
        head.dual_return = !head.dual_return;
        break;
      case 10:  // a limited field of view, whose sector lies in the next packet
        head.sector_at = 1 + input.next(1) % 11;
        head.sector_cdeg = input.next(2) % 36'000;
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
