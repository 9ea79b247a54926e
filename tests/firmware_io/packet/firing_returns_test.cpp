// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/firing_returns.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware_io/packet/beam_azimuth.hpp"

namespace terracut::packet {
namespace {

/// find_columns() for one beam: its head in some revolution, the head's advance, its offset.
struct Beam {
  std::int64_t rotor_cdeg;
  std::int32_t advance_ticks, offset_ticks;
};

std::int32_t column_by_tile(const Beam& beam, int columns) {
  TileRow<std::int32_t> rotor_column{}, rotor_rest{}, advance_column{}, advance_rest{};
  const ColumnAngle rotor = column_angle(beam.rotor_cdeg * kTicksPerCdeg, columns);
  const ColumnAngle advance = column_angle(beam.advance_ticks, columns);
  rotor_column[5] = rotor.whole;
  rotor_rest[5] = rotor.rest;
  advance_column[5] = advance.whole;
  advance_rest[5] = advance.rest;
  BeamColumns found;
  find_columns(rotor_column.data(), rotor_rest.data(), advance_column.data(), advance_rest.data(),
               column_angle(beam.offset_ticks, columns), found);
  return found.column[5];
}

std::int64_t column_by_definition(const Beam& beam, int columns) {
  const BeamAzimuth at = beam_azimuth(beam.rotor_cdeg, beam.advance_ticks + beam.offset_ticks);
  return at.frame * columns + column_of(at.in_revolution_ticks, columns);
}

TEST(FiringTile, FindsTheColumnThatColumnOfFindsAroundEveryBoundary) {
  for (const int columns : {16, 1800, 2083, 4167, 36'000}) {
    int wrong = 0;
    for (int boundary = 0; boundary <= columns; ++boundary) {
      const std::int64_t ticks = std::int64_t{boundary} * kRevolution_ticks / columns;
      const std::int64_t cdeg = ticks / kTicksPerCdeg;
      for (std::int32_t advance = 0; advance < 3; ++advance) {
        for (std::int32_t off = -2; off <= 2; ++off) {
          const auto rest = static_cast<std::int32_t>(ticks - cdeg * kTicksPerCdeg);
          const Beam beam{cdeg, 40'000 * advance, rest + off - 40'000 * advance};
          wrong += column_by_tile(beam, columns) != column_by_definition(beam, columns);
        }
      }
    }
    EXPECT_EQ(wrong, 0) << columns;
  }
}

TEST(FiringTile, CountsColumnsOnFromRevolutionToRevolution) {
  for (const std::int64_t rotor_cdeg : {-36'000, -1, 0, 1, 35'999, 36'000, 71'999}) {
    for (const std::int32_t offset_ticks : {-2'000'000, -1, 0, 1, 2'000'000}) {
      const Beam beam{rotor_cdeg, 99'999, offset_ticks};
      EXPECT_EQ(column_by_tile(beam, 2083), column_by_definition(beam, 2083))
          << rotor_cdeg << ' ' << offset_ticks;
    }
  }
}

TEST(FiringTile, SaysWhetherColumnsFollowEachOtherAndWhichAreTheFirstAndTheLast) {
  TileRow<std::int32_t> rotor_column, none{};
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    rotor_column[f] = 100 + static_cast<std::int32_t>(f);
  }
  BeamColumns found;
  const auto find = [&] {
    find_columns(rotor_column.data(), none.data(), none.data(), none.data(), {}, found);
  };
  find();
  EXPECT_TRUE(found.is_one_run);
  EXPECT_EQ(found.least, 100);
  EXPECT_EQ(found.most, 123);
  rotor_column[7] = rotor_column[6];
  find();
  EXPECT_FALSE(found.is_one_run);
  rotor_column[7] = 99;
  find();
  EXPECT_FALSE(found.is_one_run);
  EXPECT_EQ(found.least, 99);
}

TEST(FiringTile, MeasuresNothingWhereThereIsNoReturn) {
  TileRow<std::uint16_t> raw{};
  raw[3] = 1;
  raw[4] = 65'535;
  TileRow<float> measured_m{};
  measure(raw.data(), 0.002F, measured_m.data());
  EXPECT_EQ(measured_m[3], 0.002F);
  EXPECT_EQ(measured_m[4], 65'535 * 0.002F);
  EXPECT_EQ(std::ranges::count_if(measured_m, [](float m) { return m != m; }), 22);
}

}  // namespace
}  // namespace terracut::packet
