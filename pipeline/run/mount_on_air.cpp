// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/mount_on_air.hpp"

#include <chrono>

#include "pipeline/ground/mount_search.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::run {

mount::MountFinder mount_on_air(net::LiveSource& source, const sensor::SensorOnAir& sensor,
                                const decode::Decoder::Config& config,
                                const std::function<bool()>& stop_wanted,
                                const std::function<void()>& on_waiting) {
  memory::FixedMemory memory;
  decode::Decoder decoder(sensor.calibration, mount::kAtTheSensor, config, memory);
  ground::MountSearch search;
  const auto is_enough = [&] { return search.has_enough_frames() && search.found(); };
  const auto gives_up = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  while (!is_enough() && !stop_wanted() && std::chrono::steady_clock::now() < gives_up) {
    constexpr std::int64_t kAWhile_ns = 50'000'000;
    for (const decode::Datagram& datagram : source.receive(kAWhile_ns)) {
      decoder.push(datagram);
      while (const frame::Frame* frame = decoder.next()) {
        search.add_frame(*frame->image);
      }
    }
    on_waiting();
  }
  return search.finder();
}

}  // namespace terracut::run
