// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/cloud/cloud_to_image.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/frame_record.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::run {

/// Turns clouds into labels on one thread: takes clouds of one sensor one after the other, and
/// returns a label for every point.
///
///   status::FrameRecord record;
///   if (const Status labelled = pipeline.label(cloud, record); !labelled) return labelled;
///   write(record, pipeline.point_labels());
///
/// To find a mount, which needs only images, use cloud::CloudToImage.
///
/// The constructor takes the memory of the image and the method. Labelling allocates only for a
/// cloud with more points than every cloud before and than reserve() was given, and where
/// cloud::RowFinder allocates; it never throws.
class CloudPipeline {
 public:
  CloudPipeline(const cloud::SensorRows& rows, const mount::RingProfile& profile,
                const ground::MethodMaker& method);

  /// Takes memory for clouds of this many points.
  void reserve(std::size_t points);

  /// Labels one cloud, and fills in those parts of `record` that are known for a cloud. `budget`
  /// limits the time for a cut. Fails with the errors of cloud::RowFinder::find().
  [[nodiscard]] Status label(const cloud::CloudView& cloud, status::FrameRecord& record,
                             const min_cut::CutBudget& budget = {});

  /// Returns one label per point, in order. This and all following functions are about the cloud
  /// labelled last.
  [[nodiscard]] const std::vector<frame::Label>& point_labels() const noexcept {
    return point_labels_;
  }
  /// Returns the height of each point above the ground, metres, in order; NaN for points that are
  /// no return or have no place in the image; empty if the method gives no heights.
  [[nodiscard]] const std::vector<float>& point_heights_m() const noexcept {
    return point_heights_m_;
  }
  /// Returns the height of each return, by return index; empty if the method gives none.
  [[nodiscard]] std::span<const float> heights_m() const noexcept { return method_->heights_m(); }
  /// Returns one label per return, by return index of image().
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept { return method_->labels(); }
  [[nodiscard]] const frame::RangeImage& image() const noexcept { return placement_.image(); }
  /// Returns how many points became returns, and why the other points did not.
  [[nodiscard]] const scan::ScanToImage::Summary& placed() const noexcept {
    return placement_.placed();
  }
  /// Converts numbers by return index to numbers of the cloud's points, 0 for points without a
  /// return; empty for empty `of_returns`.
  [[nodiscard]] std::span<const std::uint16_t> numbers_of_points(
      std::span<const std::uint16_t> of_returns);
  /// Converts the truth of the cloud's points to that of its returns, by return index; empty for
  /// empty `truth`.
  [[nodiscard]] std::span<const std::uint32_t> truth_of_returns(
      std::span<const std::uint32_t> truth);

 private:
  void find_point_heights(std::size_t points);

  memory::FixedMemory memory_;
  cloud::CloudToImage placement_;
  std::unique_ptr<ground::FrameMethod> method_;  ///< Never null.
  StageClock clock_;
  std::vector<frame::Label> point_labels_;
  std::vector<float> point_heights_m_;
  std::vector<std::uint32_t> return_truth_;
  std::vector<std::uint16_t> point_numbers_;
};

}  // namespace terracut::run
