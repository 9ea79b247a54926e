// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/recorded_spin.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace terracut::encode {
namespace {

std::vector<std::int16_t> scan_with(std::size_t points_of_longest_ring) {
  std::vector<std::int16_t> rings(1500, 3);
  rings.insert(rings.end(), points_of_longest_ring, 40);
  rings.insert(rings.end(), 9000, scan::kNoRing);
  return rings;
}

TEST(RecordedSpin, FiresOnceForEveryPointOfTheLongestRingOfAllScans) {
  RecordedSpin spin;
  spin.add(scan_with(2140));
  spin.add(scan_with(2160));
  spin.add(scan_with(2150));
  EXPECT_EQ(spin.firings(), 2160);
  EXPECT_NEAR(spin.spin_hz(), 1 / (2160 * 48e-6), 1e-9);
}

TEST(RecordedSpin, IsTenHertzWhereRingsAreCroppedOrThereIsNone) {
  RecordedSpin spin;
  EXPECT_EQ(spin.spin_hz(), 10.0);
  spin.add(scan_with(700));
  EXPECT_EQ(spin.spin_hz(), 10.0);
  EXPECT_EQ(spin.firings(), 2083);
}

TEST(RecordedSpin, IsNoSlowerThanAHeadRotates) {
  RecordedSpin spin;
  spin.add(scan_with(9000));
  EXPECT_EQ(spin.spin_hz(), 5.0);
}

}  // namespace
}  // namespace terracut::encode
