// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/mount_on_air.hpp"

#include <chrono>

#include "pipeline/ground/mount_search.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::run {

mount::MountFinder mount_on_air(net::LiveSource& source, const streams::SensorOnAir& sensor,
                                const decode::Decoder::Config& config,
                                std::chrono::seconds patience,
                                const std::function<bool()>& stop_wanted,
                                const std::function<void(const std::string& what)>& on_waiting) {
  memory::FixedMemory memory;
  decode::Decoder decoder(sensor.calibration, mount::kAtTheSensor, config, memory);
  frame::PointImage points = decoder.point_image(memory);
  ground::MountSearch search;
  mount::MountFinder last;  // result of the last whole second
  std::string waits_for = "finding the mount";
  const auto gives_up = std::chrono::steady_clock::now() + patience;
  while (!stop_wanted() && std::chrono::steady_clock::now() < gives_up) {
    constexpr std::int64_t kAWhile_ns = 50'000'000;
    for (const packet::Datagram& datagram : source.receive(kAWhile_ns)) {
      decoder.push(datagram);
      while (const frame::Frame* frame = decoder.next()) {
        search.add_frame(points.make(*frame->returns));
      }
    }
    if (search.has_enough_frames()) {
      last = search.finder();
      const auto found = last.certain();
      if (found) return last;
      waits_for = "waiting to see how the sensor stands: " + found.error().message;
      search = {};
    }
    on_waiting(waits_for);
  }
  return last.frames_looked_at() > 0 ? last : search.finder();
}

}  // namespace terracut::run
