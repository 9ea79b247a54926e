// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

#include "firmware_io/frame/label.hpp"

namespace terracut::statistics {

/// The bands of horizontal distance from the sensor: below 20 m, 20 to 40 m, beyond.
inline constexpr std::size_t kRangeBands = 3;
inline constexpr std::array<std::string_view, kRangeBands> kRangeBandNames{"<20m", "20-40m",
                                                                           ">40m"};
[[nodiscard]] constexpr std::size_t range_band(double ground_range_m) noexcept {
  return ground_range_m < 20.0 ? 0 : ground_range_m < 40.0 ? 1 : 2;
}

/// The number of points of one class and range band by label.
struct LabelCounts {
  std::uint64_t ground = 0, obstacle = 0;
  std::uint64_t other_ground = 0;  ///< Returns of `ground` that are not road surface.

  LabelCounts& operator+=(const LabelCounts& other) noexcept {
    ground += other.ground;
    obstacle += other.obstacle;
    other_ground += other.other_ground;
    return *this;
  }
  friend bool operator==(const LabelCounts&, const LabelCounts&) = default;
};

/// Counts the points of key obstacles that lie more than 0.30 m above the true ground around them
/// (points without ground around them are left out), and how many of these were called ground.
struct TallCounts {
  std::uint64_t returns = 0, as_ground = 0;

  TallCounts& operator+=(const TallCounts& other) noexcept {
    returns += other.returns;
    as_ground += other.as_ground;
    return *this;
  }
  friend bool operator==(const TallCounts&, const TallCounts&) = default;
};

/// Counts the points of immobile classes for which the previous frame has a point within 10 cm, and
/// how many of these changed from ground to obstacle or back: in their labels, and in truth.
struct FlipCounts {
  std::uint64_t returns = 0, flips = 0, true_flips = 0;

  FlipCounts& operator+=(const FlipCounts& other) noexcept {
    returns += other.returns;
    flips += other.flips;
    true_flips += other.true_flips;
    return *this;
  }
  friend bool operator==(const FlipCounts&, const FlipCounts&) = default;
};

/// The points of a frame, or of many, by true class, range band and label: all measures, under any
/// class table, follow from these numbers.
class FrameCounts {
 public:
  struct Key {
    std::uint16_t class_id = 0;
    std::uint8_t band = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  void add(std::uint16_t class_id, std::size_t band, frame::Label label) {
    LabelCounts& counts = counts_[{class_id, static_cast<std::uint8_t>(band)}];
    ++(frame::is_ground(label) ? counts.ground : counts.obstacle);
    counts.other_ground += label == frame::Label::kOtherGround ? 1 : 0;
  }
  void add(const Key& key, const LabelCounts& counts) { counts_[key] += counts; }
  FrameCounts& operator+=(const FrameCounts& other) {
    for (const auto& [key, counts] : other.counts_) counts_[key] += counts;
    return *this;
  }

  /// Returns the counts in order of class and band.
  [[nodiscard]] const std::map<Key, LabelCounts>& by_class_and_band() const noexcept {
    return counts_;
  }
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;

 private:
  std::map<Key, LabelCounts> counts_;
};

}  // namespace terracut::statistics
