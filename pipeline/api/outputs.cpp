// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/outputs.hpp"

#include "pipeline/output/label_sink.hpp"
#include "pipeline/output/pcd_writer.hpp"

namespace terracut {

Status write_labels(const std::filesystem::path& file, std::span<const Label> labels) {
  return output::write_label_file(file, labels);
}

Status write_pcd(const std::filesystem::path& file, const Frame& frame) {
  return output::write_pcd(file, frame.points, frame.labels, frame.height_above_ground_m);
}

}  // namespace terracut
