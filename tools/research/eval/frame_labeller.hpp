// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "frame_result.hpp"
#include "method_bench.hpp"
#include "scan_way.hpp"
#include "tools/research/datasets/sequence.hpp"

namespace terracut::eval {

/// Labels scans of one sensor with several methods and counts the labels. Each scan is labelled
/// independently. One thread.
class FrameLabeller {
 public:
  /// `methods` must outlive this object. Takes all memory.
  FrameLabeller(std::span<const MethodChoice> methods, const datasets::Sequence& sequence,
                const mount::RingProfile& profile, bool through_packets);

  /// Sets the scan for label(); neither argument may change until the next scan. Fails with the
  /// errors of PacketWay::place().
  [[nodiscard]] Status place(const scan::KittiScan& scan, const scan::RingRecovery& rings);

  /// Labels the scan with methods[index]; points() then returns the labels until the next call.
  [[nodiscard]] FrameResult label(std::size_t index);

  /// Returns one label per point of the file: kNone for points without a valid position; kObstacle,
  /// the safe side, for points lost on the way to the image.
  [[nodiscard]] std::span<const frame::Label> points() const noexcept { return labels_; }

  /// placed() returns the scan as the methods see it. The next functions return the labels of
  /// methods[index], by return index of that image, and its planes, valid until the next scan.
  [[nodiscard]] const PlacedScan& placed() const noexcept { return placed_; }
  [[nodiscard]] std::span<const frame::Label> returns(std::size_t index) const {
    return bench_->labels(index);
  }
  [[nodiscard]] const stage::CellPlanes& planes(std::size_t index) const {
    return bench_->planes(index);
  }

 private:
  [[nodiscard]] const frame::ImageShape& shape() const;
  [[nodiscard]] std::size_t return_capacity() const;
  void count(FrameResult& result) const;

  memory::FixedMemory memory_;
  std::variant<std::unique_ptr<DirectWay>, std::unique_ptr<PacketWay>> way_;
  std::unique_ptr<MethodBench> bench_;  ///< Never null.

  const scan::KittiScan* scan_ = nullptr;
  const scan::RingRecovery* rings_ = nullptr;
  PlacedScan placed_;
  std::vector<frame::Label> labels_;
};

}  // namespace terracut::eval
