// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "firmware_io/sinks/frame_colours.hpp"
#include "pipeline/label.hpp"
#include "pipeline/range_image.hpp"
#include "rt/fixed_memory.hpp"

#include "tests/support/scratch_folder.hpp"

namespace terracut::firmware_io {

/// An image of 4 rows x 32 columns that a test fills return by return.
struct SmallFrame {
  rt::FixedMemory memory;
  pipeline::RangeImage image{{.rows = 4, .columns = 32}, 8, memory};
  std::vector<pipeline::Label> labels;
  std::vector<Mistake> mistakes;

  void add(int row, int column, float x_m, float y_m, float z_m, pipeline::Label label,
           std::uint8_t intensity = 100) {
    ASSERT_TRUE(image.place(row, column, {x_m, y_m, z_m, std::hypot(x_m, y_m), intensity}));
    labels.push_back(label);
  }
  [[nodiscard]] LabelledFrame frame() const { return {image, labels, mistakes}; }
};

/// A file in a folder of this test's own, removed with everything in it at the end.
class OutputFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::make_scratch_folder();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] static std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
};

}  // namespace terracut::firmware_io
