// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tools/lab/world/random.hpp"
#include "tools/research/detection/detection_bound.hpp"

namespace terracut::detection {

/// An upright box whose front faces the sensor. Its top is parallel to the ground.
struct Box {
  double azimuth_rad = 0;  ///< Of the middle of its front, as image columns count.
  double range_m = 0;      ///< From the sensor's axis to its front.
  double width_m = 0, height_m = 0, depth_m = 0;
};

/// Boxes on a tilted plane, seen by a level sensor whose every beam returns within 120 m.
class CastBoxes {
 public:
  CastBoxes(const ground::SegmenterConfig& config, const mount::RingProfile& profile,
            frame::ImageShape shape, const Assumptions& assumptions)
      : profile_(profile),
        assumptions_(assumptions),
        image_(shape, shape.cells(), memory_),
        method_(ground::maker_of(config)({profile, shape, image_.return_capacity()}, memory_)) {}

  /// Casts and labels a frame and returns for each box if it is found as DetectionBound says. The
  /// ground rises by Assumptions::slope towards `uphill_rad`. `seed` gives the roughness, the
  /// noise, and where in its columns each row's beam points. Boxes stand apart in azimuth.
  std::vector<bool> are_found(const std::vector<Box>& boxes, double uphill_rad,
                              std::uint64_t seed) {
    const frame::ImageShape& shape = image_.shape();
    const double column_rad = 2 * std::numbers::pi / shape.columns;
    std::vector<Column> columns(static_cast<std::size_t>(shape.columns));
    for (int i = 0; i < shape.columns; ++i) {
      for (const Box& box : boxes) {
        const double aside_m = box.range_m * std::tan(aside_rad(box, (i + 0.5) * column_rad));
        if (std::abs(aside_m) < box.width_m / 2 + box.range_m * column_rad) {
          columns[static_cast<std::size_t>(i)] = {.box = &box};
        }
      }
    }
    std::vector<std::size_t> on_box;
    image_.clear();
    for (int row = 0; row < shape.rows; ++row) {
      world::Random random(world::mix_keys(seed, static_cast<std::uint64_t>(row)));
      const double within = random.unit();
      for (int i = 0; i < shape.columns; ++i) {
        const double azimuth_rad = (i + within) * column_rad;
        const double ground_slope = assumptions_.slope * std::cos(azimuth_rad - uphill_rad);
        double range_m = plane_range_m(row, ground_slope, assumptions_.roughness_m * most(random));
        Column& column = columns[static_cast<std::size_t>(i)];
        if (column.box != nullptr) {
          const double box_m = box_range_m(*column.box, row, azimuth_rad, ground_slope);
          column.is_whole &= !std::isnan(box_m);
          if (box_m < range_m) {
            range_m = box_m + assumptions_.noise_m * most(random);
            on_box.push_back(shape.cell(row, i));
          }
        }
        if (!(range_m > 0 && range_m < 120)) continue;
        image_.place(row, i,
                     {static_cast<float>(range_m * std::cos(azimuth_rad)),
                      static_cast<float>(-range_m * std::sin(azimuth_rad)),
                      static_cast<float>(height_m(row, range_m)), static_cast<float>(range_m), 0});
      }
    }
    (void)method_->segment(image_);
    for (const std::size_t cell : on_box) {
      columns[cell % static_cast<std::size_t>(shape.stride())].has_obstacle |=
          method_->planes().label[cell] == frame::Label::kObstacle;
    }
    std::vector<bool> found;
    for (const Box& box : boxes) {
      int whole = 0, missed = 0;
      for (const Column& column : columns) {
        if (column.box != &box || !column.is_whole) continue;
        ++whole;
        missed += column.has_obstacle ? 0 : 1;
      }
      found.push_back(whole >= 2 && missed == 0);
    }
    return found;
  }

  /// Return the last frame and the method that labelled it.
  [[nodiscard]] const frame::RangeImage& image() const { return image_; }
  [[nodiscard]] const ground::FrameMethod& method() const { return *method_; }

 private:
  struct Column {
    const Box* box = nullptr;  // the box that its beams may meet
    bool is_whole = true;      // all its beams meet the box
    bool has_obstacle = false;
  };

  /// Returns a number in [-1, 1], a third of the time either end.
  [[nodiscard]] static double most(world::Random& random) {
    return std::clamp(3 * random.unit() - 1.5, -1.0, 1.0);
  }
  [[nodiscard]] const mount::Ring& ring(int row) const {
    return profile_.rings[static_cast<std::size_t>(row)];
  }
  /// Returns the height of a row's beam above the mount's plane.
  [[nodiscard]] double height_m(int row, double range_m) const {
    return profile_.mount.height_m + ring(row).origin_height_m +
           range_m * std::tan(ring(row).elevation_rad);
  }
  [[nodiscard]] static double aside_rad(const Box& box, double azimuth_rad) {
    return std::clamp(std::remainder(azimuth_rad - box.azimuth_rad, 2 * std::numbers::pi), -1.5,
                      1.5);
  }
  /// Returns where a row's beam meets a plane above the ground; infinity if it does not.
  [[nodiscard]] double plane_range_m(int row, double ground_slope, double above_m) const {
    const double fall = ground_slope - std::tan(ring(row).elevation_rad);
    return fall > 0 ? (height_m(row, 0) - above_m) / fall : INFINITY;
  }
  /// Returns where a beam meets a box's front or top: infinity if it passes below or above, NaN if
  /// it passes beside.
  [[nodiscard]] double box_range_m(const Box& box, int row, double azimuth_rad,
                                   double ground_slope) const {
    const double turned_rad = aside_rad(box, azimuth_rad);
    if (std::abs(box.range_m * std::tan(turned_rad)) > box.width_m / 2) return NAN;
    const double front_m = box.range_m / std::cos(turned_rad);
    const double above_m = height_m(row, front_m) - ground_slope * front_m;
    if (above_m < 0) return INFINITY;
    if (above_m <= box.height_m) return front_m;
    const double top_m = plane_range_m(row, ground_slope, box.height_m);
    return top_m <= (box.range_m + box.depth_m) / std::cos(turned_rad) ? top_m : INFINITY;
  }

  const mount::RingProfile& profile_;
  Assumptions assumptions_;
  memory::FixedMemory memory_;
  frame::RangeImage image_;
  std::unique_ptr<ground::FrameMethod> method_;
};

}  // namespace terracut::detection
