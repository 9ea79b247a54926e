// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/image_of_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "firmware_io/frame/azimuths.hpp"
#include "pipeline/stage/float_lanes.hpp"

namespace terracut::points {
namespace {

constexpr std::size_t kBlock = 512;  // points at a time

/// Moves points of a deskewed frame back to where they were measured.
class WayBack {
 public:
  explicit WayBack(const frame::FrameInfo& info) noexcept {
    for (std::size_t i = 0; i < times_s_.size(); ++i) {
      const frame::DeskewInfo::Moved& moved = info.deskew.moved[i];
      times_s_[i] =
          static_cast<float>(static_cast<double>(moved.measured_ns - info.first_packet_ns) * 1e-9);
      motions_[i] = stage::FourFloats{moved.by.cosine, moved.by.sine, moved.by.x_m, moved.by.y_m};
    }
  }

  void move(LabelledPoint& point) const noexcept {
    const stage::FourFloats motion = motion_at(point.time_s);
    const float x_m = point.x_m - motion[2], y_m = point.y_m - motion[3];
    point.x_m = motion[0] * x_m + motion[1] * y_m;
    point.y_m = motion[0] * y_m - motion[1] * x_m;
  }

 private:
  /// Returns the value of the parabola through all three motions.
  [[nodiscard]] stage::FourFloats motion_at(float time_s) const noexcept {
    const auto [a, b, c] = times_s_;
    if (!(a < b && b < c)) return motions_[2];
    return motions_[0] * ((time_s - b) * (time_s - c) / ((a - b) * (a - c))) +
           motions_[1] * ((time_s - a) * (time_s - c) / ((b - a) * (b - c))) +
           motions_[2] * ((time_s - a) * (time_s - b) / ((c - a) * (c - b)));
  }

  std::array<float, 3> times_s_;  // since the first packet
  std::array<stage::FourFloats, 3> motions_;
};

int column_of(float azimuth_rad, int columns) noexcept {
  const float columns_per_rad = static_cast<float>(columns) / (2 * std::numbers::pi_v<float>);
  return static_cast<int>(azimuth_rad * columns_per_rad);
}

void place(const LabelledPoint& point, int column, frame::RangeImage& image) noexcept {
  const auto& [rows, columns] = image.shape();
  // There is room for all points, so the number of a return is that of its point.
  (void)image.place(std::min(static_cast<int>(point.row), rows - 1),
                    std::clamp(column, 0, columns - 1),
                    {point.x_m, point.y_m, point.z_m,
                     std::sqrt(point.x_m * point.x_m + point.y_m * point.y_m), 0});
}

}  // namespace

void find_azimuths(std::span<const LabelledPoint> points, std::span<float> azimuths_rad) noexcept {
  std::array<CloudPoint, kBlock> block;
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const auto some = points.subspan(first, std::min(kBlock, points.size() - first));
    std::ranges::transform(some, block.begin(), [](const LabelledPoint& point) {
      return CloudPoint{point.x_m, point.y_m, point.z_m, 0};
    });
    frame::find_azimuths(std::span(block).first(some.size()), azimuths_rad.subspan(first));
  }
}

void place_by_azimuth(std::span<const LabelledPoint> points, frame::RangeImage& image) noexcept {
  std::array<float, kBlock> azimuth_rad;
  image.clear();
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    const auto some = points.subspan(first, std::min(kBlock, points.size() - first));
    find_azimuths(some, azimuth_rad);
    for (std::size_t i = 0; i < some.size(); ++i) {
      place(some[i], column_of(azimuth_rad[i], image.shape().columns), image);
    }
  }
}

MeasuredImage::MeasuredImage(frame::ImageShape shape, std::size_t most_points,
                             std::span<const float> beam_turns, memory::FixedMemory& memory)
    : image_(shape, most_points, memory),
      beam_turns_(beam_turns.begin(), beam_turns.end()),
      row_times_(static_cast<std::size_t>(shape.rows)) {}

const frame::RangeImage& MeasuredImage::make(const frame::FrameInfo& info,
                                             std::span<const LabelledPoint> points) noexcept {
  const auto& [rows, columns] = image_.shape();
  const FrameTiming timing = FrameTiming::of(info, beam_turns_);
  for (int row = 0; row < rows; ++row) {
    row_times_[static_cast<std::size_t>(row)] = RowTimes::of(row, columns, timing);
  }
  if (!(row_times_[0].step_s > 0)) {
    place_by_azimuth(points, image_);
    return image_;
  }
  const bool is_deskewed = info.deskew.state == frame::DeskewState::kDone;
  const WayBack back(info);
  image_.clear();
  for (LabelledPoint point : points) {
    if (is_deskewed) back.move(point);
    const auto row = std::min(static_cast<std::size_t>(point.row), row_times_.size() - 1);
    int column = row_times_[row].column_at(point.time_s);
    if (point.time_s == 0) {  // at the first packet, or before
      const CloudPoint place{point.x_m, point.y_m, point.z_m, 0};
      float azimuth_rad;
      frame::find_azimuths({&place, 1}, {&azimuth_rad, 1});
      column = column_of(azimuth_rad, columns);
    }
    place(point, column, image_);
  }
  return image_;
}

}  // namespace terracut::points
