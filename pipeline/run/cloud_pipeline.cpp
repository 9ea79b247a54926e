// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/cloud_pipeline.hpp"

#include <limits>

namespace terracut::run {
namespace {

/// Puts a value of each return, by return index, at the return's point.
template <class Value>
void put_at_points(std::span<const Value> of_returns,
                   std::span<const std::uint32_t> point_of_return,
                   std::vector<Value>& of_points) noexcept {
  for (std::size_t i = 0; i < of_returns.size(); ++i) of_points[point_of_return[i]] = of_returns[i];
}

}  // namespace

CloudPipeline::CloudPipeline(const cloud::SensorRows& rows, const mount::RingProfile& profile,
                             const ground::MethodMaker& method)
    : placement_(rows, profile.mount, memory_),
      method_(method({.profile = profile,
                      .shape = rows.shape(),
                      .return_capacity = placement_.image().return_capacity()},
                     memory_)) {}

void CloudPipeline::reserve(std::size_t points) {
  placement_.reserve(points);
  point_labels_.reserve(points);
  if (method_->gives_heights()) point_heights_m_.reserve(points);
}

void CloudPipeline::find_point_heights(std::size_t points) {
  point_heights_m_.assign(method_->gives_heights() ? points : 0,
                          std::numeric_limits<float>::quiet_NaN());
  put_at_points(heights_m(), placement_.point_of_return(), point_heights_m_);
}

Status CloudPipeline::label(const cloud::CloudView& cloud, status::FrameRecord& record,
                            const min_cut::CutBudget& budget) {
  if (Status placed = placement_.place(cloud); !placed) return placed;
  record.segmentation = method_->segment(image(), budget, &clock_);
  record.stages = clock_.take();
  placement_.labels_of_points(labels(), point_labels_);
  find_point_heights(cloud.points.size());
  record.segmentation.count(point_labels_);
  // Points that are no return have the label kNone, so they count as neither ground nor obstacle.
  const auto no_place = static_cast<std::uint32_t>(placed().no_place);
  record.segmentation.returns -= no_place;
  record.segmentation.obstacles -= no_place;
  record.info.returns = static_cast<std::uint32_t>(cloud.points.size()) - no_place;
  record.info.losses.overflow_full_returns = placed().overflow_full;
  return {};
}

std::span<const std::uint16_t> CloudPipeline::numbers_of_points(
    std::span<const std::uint16_t> of_returns) {
  point_numbers_.assign(of_returns.empty() ? 0 : point_labels_.size(), 0);
  put_at_points(of_returns, placement_.point_of_return(), point_numbers_);
  return point_numbers_;
}

std::span<const std::uint32_t> CloudPipeline::truth_of_returns(
    std::span<const std::uint32_t> truth) {
  return_truth_.clear();
  if (truth.empty()) return return_truth_;
  for (const std::uint32_t point : placement_.point_of_return())
    return_truth_.push_back(truth[point]);
  return return_truth_;
}

}  // namespace terracut::run
