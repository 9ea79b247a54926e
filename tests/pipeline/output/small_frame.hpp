// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/pictures/frame_colours.hpp"
#include "rt/memory/fixed_memory.hpp"

#include "tests/support/scratch_folder.hpp"

namespace terracut::output {

/// An image of 4 rows x 32 columns that a test fills return by return.
struct SmallFrame {
  memory::FixedMemory memory;
  frame::RangeImage image{{.rows = 4, .columns = 32}, 8, memory};
  std::vector<frame::Label> labels;
  std::vector<pictures::Mistake> mistakes;

  void add(int row, int column, float x_m, float y_m, float z_m, frame::Label label,
           std::uint8_t intensity = 100) {
    ASSERT_TRUE(image.place(row, column, {x_m, y_m, z_m, std::hypot(x_m, y_m), intensity}));
    labels.push_back(label);
  }
  [[nodiscard]] pictures::LabelledFrame frame() const { return {image, labels, mistakes}; }
};

}  // namespace terracut::output
