// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "label_flips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::statistics {
namespace {

constexpr double kSame_m = 0.10;
constexpr double kVoxel_m = 2 * kSame_m;  // so a point's neighbours lie in two voxels a direction
constexpr std::size_t kVoxels = std::size_t{1} << 18;

std::int64_t voxel_of(double metres) {
  return static_cast<std::int64_t>(std::floor(metres / kVoxel_m));
}

std::size_t hash_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  const std::uint64_t mixed = (static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U) ^
                              (static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU) ^
                              (static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U);
  return static_cast<std::size_t>((mixed ^ (mixed >> 29)) % kVoxels);
}

}  // namespace

LabelFlips::LabelFlips(const datasets::ClassTable& classes, std::size_t methods)
    : classes_(classes), labels_(methods), first_in_voxel_(kVoxels) {}

void LabelFlips::find_truth(const scan::KittiScan& scan) {
  truth_.assign(scan.points.size(), Truth::kLeftOut);
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    const datasets::ClassEntry* const entry = classes_.find(scan::semantic_class(scan.labels[i]));
    if (entry == nullptr || entry->name.starts_with("moving") || !scan::is_place(scan.points[i])) {
      continue;
    }
    const datasets::Role role = entry->role(datasets::GroundDefinition::kAll);
    if (role == datasets::Role::kIgnored) continue;
    truth_[i] = role == datasets::Role::kGround ? Truth::kGround : Truth::kObstacle;
  }
}

void LabelFlips::sort_into_voxels() {
  std::ranges::fill(first_in_voxel_, kNone);
  next_in_voxel_.assign(places_before_.size(), kNone);
  for (std::size_t i = 0; i < places_before_.size(); ++i) {
    if (truth_before_[i] == Truth::kLeftOut) continue;
    const Place& place = places_before_[i];
    std::uint32_t& first =
        first_in_voxel_[hash_of(voxel_of(place.x_m), voxel_of(place.y_m), voxel_of(place.z_m))];
    next_in_voxel_[i] = std::exchange(first, static_cast<std::uint32_t>(i));
  }
}

std::uint32_t LabelFlips::nearest_before(const Place& place) const {
  std::uint32_t nearest = kNone;
  double least = kSame_m * kSame_m;
  const std::array<std::int64_t, 2> x{voxel_of(place.x_m - kSame_m), voxel_of(place.x_m + kSame_m)};
  const std::array<std::int64_t, 2> y{voxel_of(place.y_m - kSame_m), voxel_of(place.y_m + kSame_m)};
  const std::array<std::int64_t, 2> z{voxel_of(place.z_m - kSame_m), voxel_of(place.z_m + kSame_m)};
  for (std::int64_t at_x = x[0]; at_x <= x[1]; ++at_x) {
    for (std::int64_t at_y = y[0]; at_y <= y[1]; ++at_y) {
      for (std::int64_t at_z = z[0]; at_z <= z[1]; ++at_z) {
        // Two voxels may share a list. Points of the other voxel are too far away to change the
        // result.
        for (std::uint32_t i = first_in_voxel_[hash_of(at_x, at_y, at_z)]; i != kNone;
             i = next_in_voxel_[i]) {
          const Place& other = places_before_[i];
          const double dx = place.x_m - other.x_m, dy = place.y_m - other.y_m,
                       dz = place.z_m - other.z_m;
          const double squared = dx * dx + dy * dy + dz * dz;
          if (squared > least || (squared == least && i > nearest)) continue;
          least = squared;
          nearest = i;
        }
      }
    }
  }
  return nearest;
}

void LabelFlips::look_at(const scan::KittiScan& scan,
                         const std::optional<encode::RigidMotion>& before_this) {
  std::swap(places_, places_before_);
  std::swap(truth_, truth_before_);
  places_.clear();
  for (const scan::ScanPoint& point : scan.points) {
    places_.push_back({double{point.x_m}, double{point.y_m}, double{point.z_m}});
  }
  find_truth(scan);
  partners_.assign(places_.size(), kNone);
  if (!before_this) return;
  sort_into_voxels();
  const encode::RigidMotion& T = *before_this;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (truth_[i] == Truth::kLeftOut) continue;
    const Place& p = places_[i];
    partners_[i] = nearest_before({T[0] * p.x_m + T[1] * p.y_m + T[2] * p.z_m + T[3],
                                   T[4] * p.x_m + T[5] * p.y_m + T[6] * p.z_m + T[7],
                                   T[8] * p.x_m + T[9] * p.y_m + T[10] * p.z_m + T[11]});
  }
}

FlipCounts LabelFlips::count(std::size_t method, std::span<const frame::Label> labels) {
  FlipCounts counts;
  std::vector<frame::Label>& before = labels_[method];
  for (std::size_t i = 0; i < partners_.size(); ++i) {
    const std::uint32_t partner = partners_[i];
    if (partner == kNone) continue;
    ++counts.returns;
    counts.flips += frame::is_ground(labels[i]) != frame::is_ground(before[partner]) ? 1 : 0;
    counts.true_flips += truth_[i] != truth_before_[partner] ? 1 : 0;
  }
  before.assign(labels.begin(), labels.end());
  return counts;
}

}  // namespace terracut::statistics
