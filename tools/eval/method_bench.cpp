// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "method_bench.hpp"

#include "rt/thread_cpu_clock.hpp"
#include "tools/cli/stage_clock.hpp"

namespace terracut::evaluation {

MethodBench::MethodBench(std::span<const MethodChoice> methods, const calib::RingProfile& profile,
                         const pipeline::ImageShape& shape, std::size_t return_capacity,
                         rt::FixedMemory& memory) {
  for (const MethodChoice& method : methods) {
    methods_.push_back(std::make_unique<pipeline::GroundMethod>(method.config, profile, shape,
                                                                return_capacity, memory));
  }
}

FrameTimes MethodBench::segment(std::size_t index, const pipeline::RangeImage& image) {
  FrameTimes times;
  cli::StageClock clock;
  const std::int64_t begun_ns = rt::thread_cpu_ns();
  (void)methods_[index]->segment(image, &clock);
  times.segment_ns = rt::thread_cpu_ns() - begun_ns;
  times.stage_ns = clock.times().stage_ns;
  return times;
}

std::span<const pipeline::Label> MethodBench::labels(std::size_t index) const {
  return methods_[index]->labels();
}

}  // namespace terracut::evaluation
