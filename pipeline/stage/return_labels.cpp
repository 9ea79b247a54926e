// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/return_labels.hpp"

#include <cmath>

namespace terracut::stage {

ReturnLabels::ReturnLabels(const Config& config, std::size_t return_capacity,
                           memory::FixedMemory& memory)
    : config_(config), labels_(memory.take<frame::Label>("return labels", return_capacity + 1)) {}

void ReturnLabels::assign(const frame::RangeImage& image, const CellPlanes& planes) noexcept {
  returns_ = image.returns();
  const auto index = image.return_index();
  const std::size_t nowhere = labels_.size() - 1;
  for (std::size_t cell = 0; cell < planes.label.size(); ++cell) {
    // Which cells are empty is as good as random: they write to a place of no return.
    const frame::Label label = planes.label[cell];
    labels_[label != frame::Label::kNone ? index[cell] : nowhere] = label;
  }
  for (const frame::OverflowReturn& extra : image.overflow()) {
    const float above_owner_m = extra.point.z_m - image.z_m()[extra.cell];
    const float behind_owner_m = extra.point.ground_range_m - image.ground_range_m()[extra.cell];
    const bool same_surface = std::fabs(behind_owner_m) < config_.same_surface_range_m &&
                              std::fabs(above_owner_m) < config_.same_surface_height_m;
    const float height_m = planes.height_m[extra.cell] + above_owner_m;
    const frame::Label by_height =
        height_m < config_.obstacle_height_m ? frame::Label::kGround : frame::Label::kObstacle;
    labels_[extra.return_index] = same_surface ? planes.label[extra.cell] : by_height;
  }
}

}  // namespace terracut::stage
