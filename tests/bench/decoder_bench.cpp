// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The decoders by themselves: nanoseconds per packet column (64 lasers of an HDL-64E, 128 of an
// RS-Ruby128). Reports, asserts nothing.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/decode/deskewer.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tests/firmware_io/ruby128/random_stream.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut {
namespace {

/// Ten frames at 10 Hz in which nine of ten firings find something, as on a street.
std::vector<test::Packet> street_like() {
  auto firings = test::random_firings({.last_cdeg = 35'000 + 10 * 36'000});
  // Distances that change slowly from firing to firing, so that branches behave as on real data.
  for (std::size_t n = 0; n < firings.size(); ++n) {
    for (std::size_t i = 0; i < 64; ++i) {
      auto& beam = firings[n].by_laser[i];
      const auto phase = static_cast<unsigned>(n / 40 + 7 * i);
      beam.raw = phase % 10 == 0 ? std::uint16_t{0}
                                 : static_cast<std::uint16_t>(1'000 + 300 * i + phase % 97);
    }
  }
  return test::to_packets(firings);
}

void report(benchmark::State& state, std::size_t packets, std::size_t columns_per_packet = 6) {
  const auto columns =
      static_cast<double>(state.iterations()) * static_cast<double>(columns_per_packet * packets);
  state.counters["per_column"] =
      benchmark::Counter(columns, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void decode_frames(benchmark::State& state) {
  const auto packets = street_like();
  memory::FixedMemory memory;
  decode::Decoder decoder(hdl64e::nominal_hdl64e(), {}, {}, memory);
  std::uint64_t returns = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    returns += info.returns;
  };
  for (auto _ : state) {
    for (const test::Packet& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
    test::end_stream(decoder, on_frame);
  }
  benchmark::DoNotOptimize(returns);
  report(state, packets.size());
}
BENCHMARK(decode_frames)->Unit(benchmark::kMillisecond);

/// Five frames, in single (0) or dual return (1).
void decode_ruby128_frames(benchmark::State& state) {
  const auto packets = test::random_packets({.dual = state.range(0) == 1,
                                             .first_cdeg = 35'000,
                                             .last_cdeg = 35'000 + 5 * 36'000,
                                             .share_of_returns = 0.9});
  memory::FixedMemory memory;
  decode::Decoder decoder(ruby128::nominal_ruby128(), {}, {}, memory);
  std::uint64_t returns = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    returns += info.returns;
  };
  for (auto _ : state) {
    for (const auto& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
    test::end_stream(decoder, on_frame);
  }
  benchmark::DoNotOptimize(returns);
  report(state, packets.size(), 3);
}
BENCHMARK(decode_ruby128_frames)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// The motions of one frame at 20 m/s and 0.5 rad/s to its end, and its points moved: 64 rows of
/// 2083 columns (0), 128 of 1800 (1).
void deskew_frame(benchmark::State& state) {
  const bool ruby = state.range(0) == 1;
  const frame::ImageShape shape{ruby ? 128 : 64, ruby ? 1800 : 2083};
  memory::FixedMemory memory;
  vehicle::EgoMotion motion({}, memory);
  for (std::int64_t i = -1; i < 14; ++i) motion.add({i * 10'000'000, 20, 0.5});
  std::vector<std::int32_t> beam_ticks;
  for (int row = 0; row < shape.rows; ++row) beam_ticks.push_back((row % 4 - 2) * 300'000);
  decode::Deskewer deskewer({&motion, frame::FrameInstant::kEnd, shape, packet::kRevolution_ticks},
                            beam_ticks, memory);
  for (std::int64_t i = -20; i < 380; ++i) {
    deskewer.note(i * packet::kRevolution_ticks / 360, i * 100'000'000 / 360);
  }
  frame::RangeImage image(shape, 100, memory);
  for (auto _ : state) {
    // The places of a frame, as they are not to move away.
    state.PauseTiming();
    image.clear();
    for (int row = 0; row < shape.rows; ++row) {
      for (int column = 0; column < shape.columns; ++column) {
        image.place(row, column, {10.0F + static_cast<float>(row), 5, 0, 11, 1});
      }
    }
    state.ResumeTiming();
    const decode::Deskewer::Deskewed deskewed = deskewer.deskew(0);
    if (deskewed.by_row.empty()) {
      state.SkipWithError("no ego motion");
      break;
    }
    image.move(deskewed.by_row);
  }
}
BENCHMARK(deskew_frame)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void check_packets(benchmark::State& state) {
  const auto packets = street_like();
  packet::PacketAzimuths azimuths;
  for (auto _ : state) {
    for (const test::Packet& packet : packets) {
      benchmark::DoNotOptimize(hdl64e::check_hdl64e_packet(packet.bytes, azimuths));
    }
  }
  report(state, packets.size());
}
BENCHMARK(check_packets)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace terracut
