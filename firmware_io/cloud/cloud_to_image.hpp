// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::cloud {

/// Puts clouds of one sensor into a range image, each point into the row of its laser, by the rules
/// of scan::ScanToImage.
///
///   CloudToImage to_image(rows, mount, memory);
///   if (const Status placed = to_image.place(cloud); !placed) return placed;
///   look_at(to_image.image());
///
/// Allocates only for a cloud with more points than every cloud before and than reserve() was
/// given, and where RowFinder allocates.
class CloudToImage {
 public:
  /// `mount` is that of the place from which rows are seen (SensorRows::viewpoint_above_m).
  CloudToImage(const SensorRows& rows, const mount::Mount& mount, memory::FixedMemory& memory)
      : finder_(rows),
        image_(rows.shape(), rows.shape().cells(), memory),
        to_image_(mount_of_origin(rows, mount)) {}

  /// Takes memory for clouds of `points` points.
  void reserve(std::size_t points) {
    rings_.ring_of_point.reserve(points);
    to_image_.reserve(points);
  }

  /// Places a cloud. Fails as RowFinder::find() does; the image then still holds the previous
  /// cloud.
  [[nodiscard]] Status place(const CloudView& cloud) {
    if (Status found = finder_.find(cloud, rings_); !found) return found;
    placed_ = to_image_.place(cloud.points, rings_.ring_of_point, image_);
    return {};
  }

  /// Returns the image of the last cloud placed. The functions below refer to this cloud, too.
  [[nodiscard]] const frame::RangeImage& image() const noexcept { return image_; }
  [[nodiscard]] const scan::ScanToImage::Summary& placed() const noexcept { return placed_; }
  /// Returns the index in the cloud of each return of the image (scan::ScanToImage).
  [[nodiscard]] std::span<const std::uint32_t> point_of_return() const noexcept {
    return to_image_.point_of_return();
  }
  void labels_of_points(std::span<const frame::Label> of_returns,
                        std::vector<frame::Label>& of_points) const {
    to_image_.labels_of_points(of_returns, of_points);
  }

 private:
  [[nodiscard]] static mount::Mount mount_of_origin(const SensorRows& rows, mount::Mount mount) {
    mount.height_m -= rows.viewpoint_above_m;
    return mount;
  }

  RowFinder finder_;
  frame::RangeImage image_;
  scan::ScanToImage to_image_;
  scan::RingRecovery rings_;
  scan::ScanToImage::Summary placed_;
};

}  // namespace terracut::cloud
