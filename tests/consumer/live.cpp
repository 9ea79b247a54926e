// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A live sensor's frames, labelled, until so many have come: live PORT FRAMES
#include <cstdlib>
#include <iostream>
#include <terracut/live_run.hpp>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  terracut::LiveRun::Config config;
  config.address = "127.0.0.1";
  config.port = static_cast<std::uint16_t>(std::atoi(argv[1]));
  config.calibration = terracut::Calibration::nominal(terracut::Sensor::kHdl64e);
  config.find_mount = true;  // or state it: config.mount = {.height_m = 1.73};
  config.deadline_ms = 50;
  config.patience_s = 60;
  std::size_t labels_by_sector = 0;
  config.on_sector = [&](const terracut::Sector& sector) {
    labels_by_sector += sector.labels.size();
  };
  const int wanted = std::atoi(argv[2]);
  int frames = 0;
  const auto stop_wanted = [&] { return frames >= wanted; };

  auto run = terracut::LiveRun::open(config, stop_wanted);
  if (!run) return std::cerr << run.error().message << '\n', 1;
  if (const auto& found = run->found_mount()) {
    std::cout << "the sensor stands " << found->mount.height_m << " m above the ground\n";
  }
  run->run(stop_wanted, [&](const terracut::Frame& frame) {
    ++frames;
    std::cout << "frame " << frame.number << ": " << frame.labels.size() << " labels\n";
  });
  const auto figures = run->figures();
  std::cerr << run->refusals() << figures.deadlines_missed << " deadlines missed, "
            << labels_by_sector << " labels while the sensor turned\n";
}
