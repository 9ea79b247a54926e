// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Uses a piece of every installed room, by the include paths a consumer has.
#include <terracut/calib/mount.hpp>
#include <terracut/firmware_io/sinks/label_sink.hpp>
#include <terracut/pipeline/range_image.hpp>
#include <terracut/rt/fixed_memory.hpp>

#include <iostream>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  terracut::rt::FixedMemory memory;
  terracut::pipeline::RangeImage image({.rows = 64, .columns = 2083}, 100, memory);
  const auto point = terracut::calib::apply(terracut::calib::T_vehicle_lidar({}), 10.0, 0.0, -1.73);
  image.place(0, 0, {static_cast<float>(point[0]), 0, static_cast<float>(point[2]), 10.0F, 50});
  const std::vector labels(image.returns(), terracut::pipeline::Label::kGround);
  const auto status = terracut::firmware_io::write_label_file(argv[1], labels);
  if (!status) {
    std::cerr << status.error().message << '\n';
    return 1;
  }
  std::cout << "labelled " << image.returns() << " return with the installed terracut\n";
  return 0;
}
