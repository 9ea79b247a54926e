// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <utility>

#include "rt/error.hpp"

namespace terracut::firmware_io {

/// Watches that the firings given to a DriveWriter are those of a turning head that the decoder
/// will follow: in time and azimuth, inside packets of six and from packet to packet.
class FiringOrder {
 public:
  /// kInvalidArgument, naming the firing and the rule, when the next firing cannot follow.
  [[nodiscard]] Status check(std::int64_t stamp_ns, std::int64_t azimuth_cdeg);

  /// Stamp and azimuth a regular next firing would have. After at least one firing.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> next() const noexcept;

 private:
  struct Firing {
    std::int64_t stamp_ns = 0, azimuth_cdeg = 0;
  };
  std::uint64_t firings_ = 0;
  Firing last_, packet_first_;
  std::int64_t step_ns_ = 48'000, step_cdeg_ = 17;  ///< Between the last two firings of one packet.
};

}  // namespace terracut::firmware_io
