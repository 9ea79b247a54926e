// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// One KITTI scan, labelled: cloud_to_labels 000000.bin 000000.label
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>
#include <terracut/segmenter.hpp>
#include <vector>

// Of SemanticKITTI's .label files, a uint32 a point, by Label: none, ground, obstacle, other
// ground.
constexpr std::uint32_t kClasses[] = {0, 40, 99, 49};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(argv[1], error);
  std::vector<terracut::CloudPoint> cloud(error ? 0 : bytes / 16);
  std::ifstream file(argv[1], std::ios::binary);
  if (error || !file.read(reinterpret_cast<char*>(cloud.data()),
                          static_cast<std::streamsize>(cloud.size() * 16))) {
    return std::cerr << argv[1] << " cannot be read\n", 1;
  }

  auto segmenter = terracut::Segmenter::make({.find_mount = true});
  if (!segmenter) return std::cerr << segmenter.error().message << '\n', 1;
  const auto labels = segmenter->label(cloud);
  if (!labels) return std::cerr << labels.error().message << '\n', 1;

  std::vector<std::uint32_t> classes;
  for (const terracut::Label label : *labels) {
    classes.push_back(kClasses[static_cast<std::size_t>(label)]);
  }
  std::ofstream written(argv[2], std::ios::binary);
  written.write(reinterpret_cast<const char*>(classes.data()),
                static_cast<std::streamsize>(classes.size() * 4));
  if (!written.flush()) return std::cerr << argv[2] << " cannot be written\n", 1;
  std::cout << classes.size() << " labels\n";
}
