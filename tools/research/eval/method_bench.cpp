// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_bench.hpp"

#include "pipeline/run/stage_clock.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::eval {

MethodBench::MethodBench(std::span<const MethodChoice> methods, const mount::RingProfile& profile,
                         const frame::ImageShape& shape, std::size_t return_capacity,
                         memory::FixedMemory& memory) {
  for (const MethodChoice& method : methods) {
    methods_.push_back(baselines::maker_of(method.config)(
        {.profile = profile, .shape = shape, .return_capacity = return_capacity}, memory));
  }
}

FrameTimes MethodBench::segment(std::size_t index, const frame::RangeImage& image) {
  FrameTimes times;
  run::StageClock clock;
  const std::int64_t begun_ns = measure::thread_cpu_ns();
  (void)methods_[index]->segment(image, {}, &clock);
  times.segment_ns = measure::thread_cpu_ns() - begun_ns;
  times.stage_ns = clock.take().stage_ns;
  return times;
}

std::span<const frame::Label> MethodBench::labels(std::size_t index) const {
  return methods_[index]->labels();
}

const stage::CellPlanes& MethodBench::planes(std::size_t index) const {
  return methods_[index]->planes();
}

}  // namespace terracut::eval
