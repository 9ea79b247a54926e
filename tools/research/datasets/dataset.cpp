// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dataset.hpp"

#include <fmt/format.h>

#include "firmware_io/scan/ring_table.hpp"

namespace terracut::datasets {

Expected<Dataset> Dataset::at(const CloudLayout& layout, std::filesystem::path root) {
  if (layout.rings_from == RingSource::kField || layout.rings == scan::kScanRings) {
    return Dataset(layout, std::move(root));
  }
  return fail(ErrorCode::kUnsupported,
              fmt::format("{}: rings follow from the order of a file only for sensors with {} "
                          "rings, not {}; give clouds whose points name their ring",
                          root.string(), scan::kScanRings, layout.rings));
}

Expected<std::vector<std::string>> Dataset::sequences() const {
  const FilePattern& needed = layout_.labels ? *layout_.labels : layout_.points;
  std::vector<std::string> names = layout_.sequences.names_in(root_);
  std::erase_if(names,
                [&](const std::string& name) { return needed.names_in(folder(name)).empty(); });
  if (!names.empty()) return names;
  return fail(ErrorCode::kNotFound,
              fmt::format("expected folders {} with {}{}, found none",
                          (root_ / layout_.sequences.text()).string(), layout_.points.text(),
                          layout_.labels ? " and " + layout_.labels->text() : ""));
}

}  // namespace terracut::datasets
