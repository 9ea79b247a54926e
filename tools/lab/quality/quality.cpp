// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "quality.hpp"

#include <algorithm>

namespace terracut::quality {
namespace {

double ratio(std::uint64_t part, std::uint64_t whole) noexcept {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

TruthClass truth_class(std::uint32_t semantic_kitti_id) noexcept {
  switch (semantic_kitti_id & 0xFFFFU) {
    case 0:  // unlabelled
    case 1:  // outlier
      return TruthClass::kIgnored;
    case 40:  // road
    case 44:  // parking
    case 48:  // sidewalk
    case 49:  // other ground
    case 60:  // lane marking
    case 72:  // terrain
      return TruthClass::kGround;
    case 10:  // car
    case 11:  // bicycle
    case 13:  // bus
    case 15:  // motorcycle
    case 16:  // on rails
    case 18:  // truck
    case 20:  // other vehicle
    case 30:  // person
    case 31:  // bicyclist
    case 32:  // motorcyclist
    case 252:
    case 253:
    case 254:
    case 255:
    case 256:
    case 257:
    case 258:
    case 259:  // the same classes, moving
      return TruthClass::kKeyObstacle;
    default:
      return TruthClass::kOrdinaryObstacle;
  }
}

void Quality::add(frame::Label label, std::uint32_t semantic_kitti_id) noexcept {
  const bool as_ground = is_ground(label);
  add(truth_class(semantic_kitti_id), as_ground ? 1 : 0, as_ground ? 0 : 1);
}

void Quality::add(TruthClass truth, std::uint64_t as_ground, std::uint64_t as_obstacle) noexcept {
  switch (truth) {
    case TruthClass::kIgnored:
      return;
    case TruthClass::kGround:
      ground_as_ground += as_ground;
      ground_as_obstacle += as_obstacle;
      return;
    case TruthClass::kKeyObstacle:
      key_as_ground += as_ground;
      key_as_obstacle += as_obstacle;
      break;
    case TruthClass::kOrdinaryObstacle:
      break;
  }
  obstacle_as_ground += as_ground;
  obstacle_as_obstacle += as_obstacle;
}

Quality& Quality::operator+=(const Quality& other) noexcept {
  ground_as_ground += other.ground_as_ground;
  ground_as_obstacle += other.ground_as_obstacle;
  obstacle_as_ground += other.obstacle_as_ground;
  obstacle_as_obstacle += other.obstacle_as_obstacle;
  key_as_ground += other.key_as_ground;
  key_as_obstacle += other.key_as_obstacle;
  return *this;
}

double Quality::iou_ground() const noexcept {
  return ratio(ground_as_ground, ground_as_ground + obstacle_as_ground + ground_as_obstacle);
}
double Quality::recall_key_obstacles() const noexcept {
  return ratio(key_as_obstacle, key_as_obstacle + key_as_ground);
}
double Quality::precision_ground() const noexcept {
  return ratio(ground_as_ground, ground_as_ground + obstacle_as_ground);
}
double Quality::recall_ground() const noexcept {
  return ratio(ground_as_ground, ground_as_ground + ground_as_obstacle);
}

Quality measure(std::span<const frame::Label> labels,
                std::span<const std::uint32_t> truth) noexcept {
  Quality quality;
  const std::size_t count = std::min(labels.size(), truth.size());
  for (std::size_t i = 0; i < count; ++i) quality.add(labels[i], truth[i]);
  return quality;
}

}  // namespace terracut::quality
