// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "tools/research/statistics/frame_counts.hpp"
#include "true_objects.hpp"

namespace terracut::object_measures {

/// The kinds of SemanticKITTI's instances.
enum class Kind : std::uint8_t { kCar, kPerson, kTwoWheeler, kOther };
inline constexpr std::size_t kKinds = 4;
inline constexpr std::array<std::string_view, kKinds> kKindNames{"cars", "persons", "two-wheelers",
                                                                 "other vehicles"};
/// Returns the kind of a class of SemanticKITTI; moving or not, riders with their vehicles.
[[nodiscard]] Kind kind_of(std::uint16_t semantic_class) noexcept;

/// True and found instances. An instance is found if an object shares more than half of the returns
/// that belong to either (IoU > 0.5); there is at most one such object.
struct InstanceCounts {
  std::uint64_t found = 0;
  std::uint64_t missed = 0;
  std::uint64_t false_objects = 0;  ///< Objects that lie mostly on instances and find none.
  double iou_sum = 0;               ///< Of the found ones.

  InstanceCounts& operator+=(const InstanceCounts& other) noexcept;
  /// Returns the panoptic quality, of [0, 1]: sum of IoU / (found + missed / 2 + false / 2); NaN
  /// without any instance or object.
  [[nodiscard]] double panoptic_quality() const noexcept;
  /// Returns the share of instances found; NaN without instances.
  [[nodiscard]] double recall() const noexcept;
};

/// By kind and range band (statistics::range_band) of an instance's nearest return.
struct InstancesByKind {
  std::array<std::array<InstanceCounts, statistics::kRangeBands>, kKinds> counts;

  InstancesByKind& operator+=(const InstancesByKind& other) noexcept;
  /// Returns the sum over the bands.
  [[nodiscard]] InstanceCounts of(Kind kind) const noexcept;
  /// Returns the sum over kinds and bands.
  [[nodiscard]] InstanceCounts all() const noexcept;
};

/// Compares objects with the numbered instances of 10 returns or more in `labels` (entries of
/// SemanticKITTI's label files: the class in the lower, the instance in the upper 16 bits),
/// whatever their classes. Objects are taken without the returns whose truth does not say what they
/// belong to: unlabelled ones, and vehicles and persons without a number or with fewer returns.
[[nodiscard]] InstancesByKind compare_instances(std::span<const Place> places,
                                                std::span<const std::uint32_t> labels,
                                                std::span<const std::uint32_t> found_object);

}  // namespace terracut::object_measures
