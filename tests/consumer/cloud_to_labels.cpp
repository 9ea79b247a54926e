// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// One KITTI scan, labelled: cloud_to_labels 000000.bin 000000.label
#include <fstream>
#include <iostream>
#include <terracut/segmenter.hpp>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream file(argv[1], std::ios::binary | std::ios::ate);
  std::vector<terracut::CloudPoint> cloud(static_cast<std::size_t>(file.tellg()) / 16);
  file.seekg(0).read(reinterpret_cast<char*>(cloud.data()),
                     static_cast<std::streamsize>(cloud.size() * 16));

  auto segmenter = terracut::Segmenter::make({.find_mount = true});
  if (!segmenter) return std::cerr << segmenter.error().message << '\n', 1;
  const auto labels = segmenter->label(cloud);
  if (!labels) return std::cerr << labels.error().message << '\n', 1;

  std::size_t ground = 0;
  for (const terracut::Label label : *labels) ground += label == terracut::Label::kGround ? 1 : 0;
  std::cout << ground << " of " << labels->size() << " points are ground\n";
  std::ofstream(argv[2], std::ios::binary)
      .write(reinterpret_cast<const char*>(labels->data()),
             static_cast<std::streamsize>(labels->size()));
}
