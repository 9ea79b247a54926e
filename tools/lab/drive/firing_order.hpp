// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <utility>

#include "rt/error.hpp"

namespace terracut::drive {

/// What a sensor's decoder will follow from firing to firing.
struct FiringLimits {
  /// The fewest firings that fill whole packets. Where they take several packets, those share a
  /// firing.
  int firings_per_group = 1;
  std::int64_t least_step_cdeg = 1;   ///< From any firing to the next.
  std::int64_t most_step_cdeg = 100;  ///< Inside a group.
  std::int64_t most_step_ns = 0;      ///< Inside a group.
  std::int64_t usual_step_ns = 0;     ///< Where no firing has told yet.
  std::int64_t usual_step_cdeg = 0;
};

/// Watches that the firings given to a DriveWriter are those of a rotating head that the decoder
/// will follow: in time and azimuth, inside groups and from group to group.
class FiringOrder {
 public:
  explicit FiringOrder(const FiringLimits& limits) noexcept
      : limits_(limits), step_ns_(limits.usual_step_ns), step_cdeg_(limits.usual_step_cdeg) {}

  /// kInvalidArgument, naming the firing and the rule, when the next firing cannot follow.
  [[nodiscard]] Status check(std::int64_t stamp_ns, std::int64_t azimuth_cdeg);

  /// kInvalidArgument unless these are stamp and azimuth of the last firing: its second return.
  [[nodiscard]] Status check_second_return(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) const;

  /// Stamp and azimuth of the last firing. After at least one.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> last() const noexcept {
    return {last_.stamp_ns, last_.azimuth_cdeg};
  }
  /// Stamp and azimuth a regular next firing would have. After at least one.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> next() const noexcept {
    return {last_.stamp_ns + step_ns_, last_.azimuth_cdeg + step_cdeg_};
  }

 private:
  struct Firing {
    std::int64_t stamp_ns = 0, azimuth_cdeg = 0;
  };

  [[nodiscard]] Status check_step(bool in_group, std::int64_t step_ns,
                                  std::int64_t step_cdeg) const;
  [[nodiscard]] Status check_gap(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) const;

  FiringLimits limits_;
  std::uint64_t firings_ = 0;
  Firing last_, group_first_;
  std::int64_t step_ns_, step_cdeg_;  ///< Between the last two firings of one group.
};

}  // namespace terracut::drive
