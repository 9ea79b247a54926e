// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/label_sink.hpp"

#include <algorithm>
#include <vector>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::output {

Status write_label_file(const std::filesystem::path& path, std::span<const frame::Label> labels,
                        std::span<const std::uint16_t> objects) {
  std::vector<std::uint32_t> ids(labels.size());
  std::transform(labels.begin(), labels.end(), ids.begin(), semantic_kitti_class);
  for (std::size_t i = 0; i < objects.size(); ++i) ids[i] |= std::uint32_t{objects[i]} << 16;
  return scan::write_label_ids(path, ids);
}

}  // namespace terracut::output
