// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_on_air.hpp"

#include <chrono>
#include <memory>

#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

MountChoice mount_on_air(net::LiveSource& source, const sensor::SensorOnAir& sensor,
                         const Options& options, const OnWaiting& on_waiting) {
  if (!is_mount_open(options.mount)) return {options.mount, {}};
  memory::FixedMemory memory;
  decode::Decoder decoder(sensor.calibration, kAtTheSensor,
                          decoder_config_of(options, sensor.columns, FramesAreFor::kPoints),
                          memory);
  const auto ground = std::make_unique<ground::NearGround>();
  mount::MountFinder finder;
  const auto is_enough = [&] {
    return finder.frames_looked_at() >= kMountFrames && finder.found();
  };
  const auto gives_up = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  while (!is_enough() && !stop_wanted() && std::chrono::steady_clock::now() < gives_up) {
    constexpr std::int64_t kAWhile_ns = 50'000'000;
    for (const decode::Datagram& datagram : source.receive(kAWhile_ns)) {
      decoder.push(datagram);
      while (const frame::Frame* frame = decoder.next()) {
        ground::take_near_ground(*frame->image, *ground);
        finder.add_frame(ground->in_use());
      }
    }
    on_waiting("finding the mount");
  }
  return choose_mount(options.mount, finder);
}

}  // namespace terracut::cli
