// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/complete_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/points/image_of_points.hpp"

namespace terracut::points {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;
/// After that way it is certain which way round the sensor turns: its lasers' azimuths differ less.
constexpr double kSureWay_rad = kTurn_rad / 8;

/// Returns the same direction between -pi and pi.
float folded_rad(float angle_rad) noexcept {
  return std::remainder(angle_rad, static_cast<float>(kTurn_rad));
}

float range_m(const LabelledPoint& point) noexcept {
  return std::sqrt(point.x_m * point.x_m + point.y_m * point.y_m);
}

}  // namespace

CompleteObjects::CompleteObjects(const mount::RingProfile& profile, frame::ImageShape shape,
                                 std::size_t most_points)
    : image_(shape, most_points, memory_),
      planes_(shape, memory_),
      finder_(config_, profile, shape, most_points, memory_),
      labels_(most_points, frame::Label::kObstacle),
      azimuths_rad_(most_points) {
  points_.reserve(most_points);
  origins_.reserve(most_points);
  stretches_.reserve(objects::ObjectFinder::kMostObjects);
  complete_.reserve(objects::ObjectFinder::kMostObjects);
}

std::span<const CompleteObject> CompleteObjects::take(const SectorRecord& sector,
                                                      std::span<const LabelledPoint> points,
                                                      std::span<const float> heights_m) noexcept {
  complete_.clear();
  points = points.first(std::min(points.size(), azimuths_rad_.size()));
  if (points.empty()) return {};
  if (sectors_ == 0 || (sector.frame != frame_ && sector.frame != frame_ + 1)) begin();
  frame_ = sector.frame;
  find_azimuths(points, azimuths_rad_);
  advance(std::span(azimuths_rad_).first(points.size()));
  keep_obstacles(sector, points, heights_m);
  if (++sectors_ % kSectorsALook == 0 && last_way_rad_ > kSureWay_rad) look();
  return complete_;
}

void CompleteObjects::begin() noexcept {
  sectors_ = 0;
  direction_ = 1;
  last_way_rad_ = edge_rad_ = 0;
  points_.clear();
  origins_.clear();
}

void CompleteObjects::advance(std::span<const float> azimuths_rad) noexcept {
  const float middle_rad = azimuths_rad[azimuths_rad.size() / 2];
  if (sectors_ > 0) last_way_rad_ += direction_ * folded_rad(middle_rad - last_azimuth_rad_);
  last_azimuth_rad_ = middle_rad;
  if (last_way_rad_ < -kSureWay_rad) turn_around();
  float least_rad = 0, most_rad = 0;
  for (const float azimuth_rad : azimuths_rad) {
    const float ahead_rad = direction_ * folded_rad(azimuth_rad - middle_rad);
    least_rad = std::min(least_rad, ahead_rad);
    most_rad = std::max(most_rad, ahead_rad);
  }
  if (sectors_ == 0) {
    begin_rad_ = std::max(-least_rad, most_rad);  // whichever way it turns
  } else {
    edge_rad_ = std::max(edge_rad_, last_way_rad_ + least_rad);
  }
}

void CompleteObjects::turn_around() noexcept {
  direction_ = -direction_;
  last_way_rad_ = -last_way_rad_;
  edge_rad_ = 0;
  for (Origin& origin : origins_) origin.way_rad = -origin.way_rad;
}

void CompleteObjects::keep_obstacles(const SectorRecord& sector,
                                     std::span<const LabelledPoint> points,
                                     std::span<const float> heights_m) noexcept {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].label != frame::Label::kObstacle) continue;
    if (points_.size() == points_.capacity()) return;
    const float ahead_rad = direction_ * folded_rad(azimuths_rad_[i] - last_azimuth_rad_);
    points_.push_back(points[i]);
    origins_.push_back({last_way_rad_ + ahead_rad, sector.first_packet_ns, sector.frame,
                        sector.first_return + static_cast<std::uint32_t>(i), heights_m[i], false});
  }
}

void CompleteObjects::look() noexcept {
  place_by_azimuth(points_, image_);
  for (std::size_t cell = 0; cell < planes_.label.size(); ++cell) {
    const bool is_there = image_.has_return(cell);
    planes_.label[cell] = is_there ? frame::Label::kObstacle : frame::Label::kNone;
    if (is_there) planes_.height_m[cell] = origins_[image_.return_index()[cell]].height_m;
  }
  finder_.find(image_, planes_, std::span(labels_).first(points_.size()));
  measure_objects();
  hand_out();
  forget();
}

void CompleteObjects::measure_objects() noexcept {
  constexpr double kNowhere_rad = 1e12;
  stretches_.assign(finder_.objects().size(),
                    {kNowhere_rad, -kNowhere_rad, 1e6F, 0, 0, false, false});
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::uint16_t number = finder_.object_of_return()[i];
    if (number == 0) continue;
    const Origin& origin = origins_[i];
    Stretch& stretch = stretches_[number - 1U];
    const bool is_first = stretch.begin_rad > stretch.end_rad;
    if (is_first || origin.frame != stretch.frame) {
      stretch.frame = origin.frame;
      stretch.first_return = origin.return_index;
    }
    stretch.begin_rad = std::min(stretch.begin_rad, origin.way_rad);
    stretch.end_rad = std::max(stretch.end_rad, origin.way_rad);
    stretch.nearest_m = std::min(stretch.nearest_m, range_m(points_[i]));
  }
  for (Stretch& stretch : stretches_) {
    stretch.is_closed = is_closed(stretch.end_rad, stretch.nearest_m);
  }
  // What is seen on both sides of a post may be one object, as long as the post is there.
  for (Stretch& stretch : stretches_) {
    stretch.is_over = stretch.is_closed && std::ranges::none_of(stretches_, [&](const Stretch& of) {
                        return !of.is_closed && of.begin_rad <= stretch.end_rad &&
                               of.end_rad >= stretch.begin_rad;
                      });
  }
}

void CompleteObjects::hand_out() noexcept {
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const Stretch& stretch = stretches_[i];
    objects::Object object = finder_.objects()[i];
    const bool is_at_beginning = stretch.begin_rad - reach_rad(stretch.nearest_m) < begin_rad_;
    if (!stretch.is_closed || is_at_beginning || origins_[object.first_return].is_handed_out) {
      continue;
    }
    const Origin& last = origins_[object.last_return];
    object.first_return = stretch.first_return;
    object.last_return = last.return_index;
    complete_.push_back({object, stretch.frame, last.first_packet_ns});
  }
}

void CompleteObjects::forget() noexcept {
  const double oldest_rad = edge_rad_ - kMostWay_turns * kTurn_rad;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::uint16_t number = finder_.object_of_return()[i];
    const Stretch* const stretch = number == 0 ? nullptr : &stretches_[number - 1U];
    const Origin& origin = origins_[i];
    if (origin.way_rad < oldest_rad ||
        (stretch != nullptr ? stretch->is_over : is_closed(origin.way_rad, range_m(points_[i])))) {
      continue;
    }
    points_[kept] = points_[i];
    origins_[kept] = origin;
    origins_[kept].is_handed_out = stretch != nullptr && stretch->is_closed;
    ++kept;
  }
  points_.resize(kept);
  origins_.resize(kept);
}

float CompleteObjects::reach_rad(float range_m) const noexcept {
  const float reach_m = std::max(2 * config_.gap_m, config_.nearby.join_m);
  return range_m > reach_m ? reach_m / range_m : std::numbers::pi_v<float>;
}

}  // namespace terracut::points
