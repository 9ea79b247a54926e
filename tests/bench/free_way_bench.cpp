// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What the free way and the view cost a frame of an HDL-64E: level ground with some boxes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/free_way/free_way.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/points/sight_of_points.hpp"
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
  ground::Segmenter method{{}, profile, shape, image.return_capacity(), memory};
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
  points::SightOfPoints sight(scene.profile, scene.shape, points.size(), beam_turns);
  for (auto _ : state) {
    sight.look(points, heights_m, info);
    benchmark::ClobberMemory();
  }
  state.counters["points"] = static_cast<double>(points.size());
}
BENCHMARK(judge_the_view_of_points)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace terracut
