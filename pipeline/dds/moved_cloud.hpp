// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "derived_cloud.hpp"

namespace terracut::dds {

/// A cloud in another frame: a copy whose fields x, y and z are moved. Its other fields are those
/// of the original, which must have passed terracut::unpack() and must outlive this object. The
/// copy lies in memory that the next one reuses.
class MovedCloud {
 public:
  /// True if x, y and z of the cloud are numbers with fractions, as move() requires.
  [[nodiscard]] static bool can_move(const RosCloud& cloud) noexcept;

  [[nodiscard]] const RosCloud& move(const RosCloud& from, const mount::RigidTransform& T_to_from,
                                     const std::string& frame);

 private:
  RosCloud cloud_{};
  std::string frame_;
  std::vector<std::uint8_t> data_;
};

}  // namespace terracut::dds
