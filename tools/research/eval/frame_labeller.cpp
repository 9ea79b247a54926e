// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_labeller.hpp"

#include <cmath>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::eval {

using frame::Label;
using scan::ScanPoint;

FrameLabeller::FrameLabeller(std::span<const MethodChoice> methods,
                             const datasets::Sequence& sequence, const mount::RingProfile& profile,
                             bool through_packets) {
  if (through_packets) {
    way_ = std::make_unique<PacketWay>(scan::hdl64e_calibration(sequence.rings()), sequence.spin(),
                                       profile.mount, memory_);
  } else {
    way_ = std::make_unique<DirectWay>(sequence.shape(), profile.mount, memory_);
  }
  bench_ = std::make_unique<MethodBench>(methods, profile, shape(), return_capacity(), memory_);
}

const frame::ImageShape& FrameLabeller::shape() const {
  return *std::visit([](const auto& way) { return &way->shape(); }, way_);
}

std::size_t FrameLabeller::return_capacity() const {
  return std::visit([](const auto& way) { return way->return_capacity(); }, way_);
}

Status FrameLabeller::place(const scan::KittiScan& scan, const scan::RingRecovery& rings) {
  scan_ = &scan;
  rings_ = &rings;
  const auto placed = std::visit(
      [&](const auto& way) { return way->place(scan.points, rings.ring_of_point); }, way_);
  if (!placed) return tl::unexpected(placed.error());
  placed_ = *placed;
  return {};
}

FrameResult FrameLabeller::label(std::size_t index) {
  FrameResult result;
  result.times = bench_->segment(index, *placed_.image);
  result.times.decode_ns = placed_.decode_ns;

  labels_.resize(scan_->points.size());
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    labels_[i] = scan::is_place(scan_->points[i]) ? Label::kObstacle : Label::kNone;
  }
  const auto of_returns = bench_->labels(index);
  for (std::size_t i = 0; i < placed_.point_of_return.size(); ++i) {
    labels_[placed_.point_of_return[i]] = of_returns[i];
  }
  count(result);
  return result;
}

void FrameLabeller::count(FrameResult& result) const {
  result.points = scan_->points.size();
  result.non_finite = scan_->no_place;
  result.no_ring = rings_->no_ring - scan_->no_place;
  result.not_placed =
      result.points - result.non_finite - result.no_ring - placed_.point_of_return.size();
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (labels_[i] == Label::kNone) continue;
    const ScanPoint& point = scan_->points[i];
    result.counts.add(scan::semantic_class(scan_->labels[i]),
                      statistics::range_band(std::hypot(double{point.x_m}, double{point.y_m})),
                      labels_[i]);
  }
}

}  // namespace terracut::eval
