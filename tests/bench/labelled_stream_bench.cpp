// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the stream of labelled frames costs: packing on the segment thread, as it is done and row by
// row, and serving on the sink's thread. Reports, asserts nothing.
#include <benchmark/benchmark.h>

#include <atomic>
#include <thread>
#include <vector>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/output/label_sink.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/stream/frame_stream_server.hpp"
#include "tests/support/frame_stream_reader.hpp"

namespace terracut {
namespace {

using points::LabelledPoint;

/// A frame of rows x columns that arrives firing by firing, each row shifted against the others as
/// by its laser's rotational correction; `full_percent` of the cells hold a return.
struct Frame {
  Frame(int rows, int columns, int full_percent)
      : image({.rows = rows, .columns = columns}, 64, memory), points(image.return_capacity()) {
    for (int firing = 0; firing < columns; ++firing) {
      for (int laser = 0; laser < rows; ++laser) {
        // Two rows arrive one after the other that lie half the image apart, as with the HDL-64E.
        const int row = laser / 2 + (laser % 2) * (rows / 2);
        if ((firing * 31 + laser * 17) % 100 >= full_percent) continue;
        const int shift = row * 37 % 41 - 20;
        const auto x_m = static_cast<float>(firing);
        (void)image.place(row, (firing + shift + columns) % columns,
                          {x_m, 1.0F, 0.1F, x_m, static_cast<std::uint8_t>(laser)});
      }
    }
    labels.resize(image.returns());
    for (std::size_t n = 0; n < labels.size(); ++n) {
      labels[n] = n % 5 < 3 ? frame::Label::kGround : frame::Label::kObstacle;
    }
  }

  memory::FixedMemory memory;
  frame::RangeImage image;
  std::vector<frame::Label> labels;
  std::vector<LabelledPoint> points;
};

void report(benchmark::State& state, const Frame& frame) {
  state.counters["returns"] = static_cast<double>(frame.image.returns());
  state.SetItemsProcessed(static_cast<std::int64_t>(frame.image.returns()) *
                          static_cast<std::int64_t>(state.iterations()));
}

/// 64 rows: 124,000 returns, an HDL-64E's frame. 128 rows: 256,000, a full RS-Ruby128's in 2,000
/// columns.
Frame frame_for(std::int64_t rows) {
  return rows == 64 ? Frame(64, 2083, 93) : Frame(128, 2000, 100);
}

void pack_points(benchmark::State& state) {
  Frame frame = frame_for(state.range(0));
  for (auto each : state) {
    benchmark::DoNotOptimize(points::pack_labelled_points(frame.image, frame.labels, frame.points));
    benchmark::ClobberMemory();
  }
  report(state, frame);
}
BENCHMARK(pack_points)->Arg(64)->Arg(128)->Unit(benchmark::kMicrosecond);

/// The other order of walking the image, for comparison.
void pack_points_row_by_row(benchmark::State& state) {
  Frame frame = frame_for(state.range(0));
  for (auto each : state) {
    frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
      frame.points[placed.return_index] = {placed.point.x_m,
                                           placed.point.y_m,
                                           placed.point.z_m,
                                           placed.point.intensity,
                                           frame.labels[placed.return_index],
                                           static_cast<std::uint16_t>(placed.row)};
    });
    benchmark::ClobberMemory();
  }
  report(state, frame);
}
BENCHMARK(pack_points_row_by_row)->Arg(64)->Arg(128)->Unit(benchmark::kMicrosecond);

/// One frame to `readers` readers over the loopback, until all of them have it. CPU time is that of
/// the serving thread alone.
void serve_frame(benchmark::State& state) {
  const Frame frame = frame_for(state.range(0));
  const auto readers = static_cast<std::size_t>(state.range(1));
  memory::FixedMemory memory;
  auto server = stream::FrameStreamServer::open(
      {.max_points = frame.image.returns(), .max_peers = readers}, memory);
  if (!server) return state.SkipWithError(server.error().message.c_str());
  std::vector<std::jthread> threads;
  std::atomic<std::uint64_t> received{0};
  for (std::size_t n = 0; n < readers; ++n) {
    threads.emplace_back([&received, address = server->address()] {
      auto reader = test::FrameStreamReader::connect(address);
      test::ReceivedFrame got;
      while (reader && reader->next(got, -1).value_or(false)) ++received;
    });
  }
  while (server->peers() < readers) server->work_round();
  const std::size_t returns = frame.image.returns();
  const stream::LabelledFrame labelled{
      stream::header_of(status::FrameRecord{}, sensor::SensorModel::kUnknown, false, returns),
      std::span(frame.points).first(returns)};
  std::uint64_t expected = 0;
  for (auto each : state) {
    server->serve(labelled);
    state.PauseTiming();
    expected += readers;
    while (received < expected && server->figures().missed == 0) {
      server->work_round();
      std::this_thread::yield();
    }
    state.ResumeTiming();
  }
  if (server->figures().missed > 0) state.SkipWithError("a reader missed a frame");
  server = stream::FrameStreamServer::open({.max_points = 1}, memory);  // ends the readers
}
BENCHMARK(serve_frame)
    ->ArgsProduct({{64, 128}, {1, 4}})
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(200);

}  // namespace
}  // namespace terracut
