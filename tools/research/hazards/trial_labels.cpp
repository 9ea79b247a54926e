// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "trial_labels.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::hazards {

using frame::Label;

TrialLabels::TrialLabels(std::span<const eval::MethodChoice> methods, const LabelledFrame& frame,
                         const mount::RingProfile& profile)
    : frame_(frame),
      image_(frame.shape, frame.shape.cells(), memory_),
      bench_(methods, profile, frame.shape, image_.return_capacity(), memory_),
      labels_(methods.size()) {}

void TrialLabels::place(const MovedReturns& moved) {
  image_.clear();
  placed_.clear();
  auto next = moved.begin();
  for (std::uint32_t i = 0; i < frame_.size(); ++i) {
    Eigen::Vector3d at = frame_.at[i];
    if (next != moved.end() && next->index == i) {
      const double range_m = (next++)->range_m;
      if (range_m <= 0) continue;
      at = frame_.sensor + range_m * frame_.beam[i];
    }
    const frame::Return point{static_cast<float>(at.x()), static_cast<float>(at.y()),
                              static_cast<float>(at.z()),
                              static_cast<float>(std::hypot(at.x(), at.y())), frame_.intensity[i]};
    const LabelledFrame::Cell cell = frame_.cell[i];
    if (image_.place(cell.row, cell.column, point, frame::CellOwner::kNearest)) {
      placed_.push_back(i);
    }
  }
}

void TrialLabels::label(const MovedReturns& moved) {
  place(moved);
  for (std::size_t method = 0; method < labels_.size(); ++method) {
    (void)bench_.segment(method, image_);
    labels_[method].assign(frame_.size(), Label::kNone);
    const auto labels = bench_.labels(method);
    for (std::size_t i = 0; i < placed_.size(); ++i) labels_[method][placed_[i]] = labels[i];
  }
}

}  // namespace terracut::hazards
