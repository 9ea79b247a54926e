// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What the free way and the view cost a frame of an HDL-64E, level ground with some boxes, and what
// messages of the free way cost.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/free_way/free_way.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/ros_messages/free_way_messages.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "pipeline/visibility/visibility.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut {
namespace {

/// A labelled frame.
struct Scene {
  Scene() {
    std::vector<test::Box> boxes;
    for (int i = 0; i < 12; ++i) {
      const double x_m = -40 + 7 * i, y_m = i % 2 == 0 ? 5 : -6;
      boxes.push_back({x_m, x_m + 4, y_m, y_m + 1.8, 0.2, 1.5});
    }
    boxes.push_back({-60, 60, 12, 13, 0, 8});
    test::cast_frame(profile, test::ground_with_boxes(boxes), image);
    (void)method.segment(image);
  }

  frame::ImageShape shape{64, 2083};
  memory::FixedMemory memory;
  mount::RingProfile profile = test::even_profile();
  frame::RangeImage image{shape, 1000, memory};
  ground::Segmenter method{[] {
                             ground::SegmenterConfig config;
                             config.gives_heights = true;
                             return config;
                           }(),
                           profile, shape, image.return_capacity(), memory};
};

void find_the_free_way(benchmark::State& state) {
  Scene scene;
  free_way::FreeWay free_way({}, scene.profile, scene.shape, scene.memory);
  for (auto _ : state) {
    free_way.find(scene.image, scene.method.planes(), scene.method.labels());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(find_the_free_way)->Unit(benchmark::kMicrosecond);

void find_the_free_way_of_returns(benchmark::State& state) {
  Scene scene;
  scene::SceneFinder finder({.free_way = true}, scene.profile, scene.shape,
                            scene.image.return_capacity(), scene.memory);
  for (auto _ : state) {
    finder.find(scene.image, scene.method.labels(), scene.method.heights_m());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(find_the_free_way_of_returns)->Unit(benchmark::kMicrosecond);

/// As `live` does it, with a deskewed turn.
void find_the_free_way_of_points(benchmark::State& state) {
  Scene scene;
  const std::vector<float> straight(static_cast<std::size_t>(scene.shape.rows));
  points::SceneOfPoints finder({.free_way = true}, scene.profile, scene.shape,
                               scene.image.return_capacity(), straight);
  frame::FrameInfo info;
  info.last_packet_ns = 100'000'000;
  info.head = {0, 1};
  info.deskew.state = frame::DeskewState::kDone;
  for (std::size_t i = 0; i < 3; ++i) {
    info.deskew.moved[i].measured_ns = static_cast<std::int64_t>(i) * 50'000'000;
  }
  std::vector<points::LabelledPoint> points(scene.image.returns());
  (void)points::pack_labelled_points(scene.image, scene.method.labels(), points,
                                     points::FrameTiming::of(info, straight));
  for (auto _ : state) {
    finder.find(info, points, scene.method.heights_m());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(find_the_free_way_of_points)->Unit(benchmark::kMicrosecond);

using Write = void (*)(const publish::LabelledFrame&, std::string_view, std::vector<std::byte>&);
void write_a_message(benchmark::State& state, Write write) {
  Scene scene;
  scene::SceneFinder finder({.free_way = true}, scene.profile, scene.shape,
                            scene.image.return_capacity(), scene.memory);
  finder.find(scene.image, scene.method.labels(), scene.method.heights_m());
  publish::LabelledFrame frame;
  publish::set_scene(finder, frame);
  std::vector<std::byte> message;
  for (auto _ : state) {
    write(frame, "terracut_ground", message);
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = static_cast<double>(message.size());
}
BENCHMARK_CAPTURE(write_a_message, scan, ros_messages::write_free_way_scan)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(write_a_message, polygon, ros_messages::write_free_way_polygon)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(write_a_message, grid, ros_messages::write_free_way_grid)
    ->Unit(benchmark::kMicrosecond);

void judge_the_view(benchmark::State& state) {
  Scene scene;
  visibility::Visibility view({}, scene.profile, scene.shape, scene.memory);
  for (auto _ : state) {
    view.look(scene.image, scene.method.planes());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(judge_the_view)->Unit(benchmark::kMicrosecond);

/// The same of a turn's points, as behind a live run's deadline.
void judge_the_view_of_points(benchmark::State& state) {
  const Scene scene;
  const std::vector<float> beam_turns(static_cast<std::size_t>(scene.shape.rows));
  frame::FrameInfo info;
  info.complete = true;
  info.head = {.first_turns = 0, .last_turns = 1};
  info.last_packet_ns = 100'000'000;
  std::vector<points::LabelledPoint> points(scene.image.returns());
  std::vector<float> heights_m(points.size());
  (void)points::pack_labelled_points(scene.image, scene.method.labels(), points,
                                     points::FrameTiming::of(info, beam_turns));
  std::ranges::transform(points, heights_m.begin(), &points::LabelledPoint::z_m);
  points::SceneOfPoints sight({.sight = true}, scene.profile, scene.shape, points.size(),
                              beam_turns);
  for (auto _ : state) {
    sight.find(info, points, heights_m);
    benchmark::ClobberMemory();
  }
  state.counters["points"] = static_cast<double>(points.size());
}
BENCHMARK(judge_the_view_of_points)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace terracut
