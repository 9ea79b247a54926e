// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/ruby128_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::ruby128 {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// validate() after a change.
template <class Change>
Status validated(Change change) {
  Ruby128Calibration calibration = nominal_ruby128();
  calibration.origin = "unit.csv";
  change(calibration);
  Status status = validate(calibration);
  return status;
}

TEST(Ruby128Calibration, AcceptsAPlausibleTable) {
  EXPECT_TRUE(validated([](Ruby128Calibration&) {}).has_value());
}

TEST(Ruby128Calibration, AcceptsAUnitAFewHundredthsOfADegreeOff) {
  const Status status = validated([](Ruby128Calibration& c) {
    for (std::size_t i = 0; i < c.channels.size(); ++i) {
      c.channels[i].elevation_rad += beams::deg_to_rad(0.02 * (static_cast<double>(i % 5) - 2));
      c.channels[i].azimuth_offset_rad -=
          beams::deg_to_rad(0.03 * (static_cast<double>(i % 7) - 3));
    }
  });
  EXPECT_TRUE(status.has_value()) << status.error().message;
}

TEST(Ruby128Calibration, NamesOriginChannelValueAndSpanOfABadValue) {
  EXPECT_THAT(
      validated([](auto& c) { c.channels[17].azimuth_offset_rad = beams::deg_to_rad(-30.5); }),
      calib::IsRefusedWith(
          ErrorCode::kMalformed,
          AllOf(HasSubstr("unit.csv"), HasSubstr("channel 18 of 128"),
                HasSubstr("azimuth offset is -30.5 deg"), HasSubstr("-10 to 10 deg"))));
  EXPECT_THAT(validated([](auto& c) { c.channels[4].elevation_rad = beams::deg_to_rad(16.25); }),
              calib::IsRefusedWith(ErrorCode::kMalformed, AllOf(HasSubstr("channel 5 of 128"),
                                                                HasSubstr("elevation is 16.25"),
                                                                HasSubstr("-26 to 16 deg"))));
}

TEST(Ruby128Calibration, RefusesWhatIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(), 1e300}) {
    EXPECT_FALSE(validated([&](auto& c) { c.channels[127].elevation_rad = bad; }));
    EXPECT_FALSE(validated([&](auto& c) { c.channels[127].azimuth_offset_rad = bad; }));
  }
}

TEST(Ruby128Calibration, LimitsThemselvesAreAllowed) {
  const auto with = [](double lowest_deg, double highest_deg, double offset_deg) {
    return validated([=](auto& c) {
             c.channels[35].elevation_rad = beams::deg_to_rad(lowest_deg);
             c.channels[124].elevation_rad = beams::deg_to_rad(highest_deg);
             c.channels[0].azimuth_offset_rad = beams::deg_to_rad(offset_deg);
           })
        .has_value();
  };
  EXPECT_TRUE(with(-26, 16, 10));
  EXPECT_TRUE(with(-24, 14, -10));
  EXPECT_FALSE(with(-26.001, 15, 0));
  EXPECT_FALSE(with(-23.999, 15, 0));
  EXPECT_FALSE(with(-25, 16.001, 0));
  EXPECT_FALSE(with(-25, 13.999, 0));
  EXPECT_FALSE(with(-25, 15, 10.001));
}

TEST(Ruby128Calibration, NamesTheOuterRowThatIsWrong) {
  EXPECT_THAT(validated([](auto& c) { c.channels[35].elevation_rad = beams::deg_to_rad(-22); }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("channel 36 of 128"), HasSubstr("lowest"),
                                         HasSubstr("-22 deg"), HasSubstr("-26 to -24"))));
  EXPECT_THAT(validated([](auto& c) { c.channels[124].elevation_rad = beams::deg_to_rad(12); }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("channel 125 of 128"), HasSubstr("highest"),
                                         HasSubstr("12 deg"), HasSubstr("14 to 16"))));
}

TEST(Ruby128Calibration, NamesDegreesTakenForRadiansAndTheOtherWayRound) {
  EXPECT_THAT(validated([](auto& c) {
                for (Ruby128Channel& channel : c.channels) {
                  channel.elevation_rad = beams::rad_to_deg(channel.elevation_rad);
                  channel.azimuth_offset_rad = beams::rad_to_deg(channel.azimuth_offset_rad);
                }
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("looks like degrees where radians were expected")));
  EXPECT_THAT(validated([](auto& c) {
                for (Ruby128Channel& channel : c.channels) {
                  channel.elevation_rad = beams::deg_to_rad(channel.elevation_rad);
                  channel.azimuth_offset_rad = beams::deg_to_rad(channel.azimuth_offset_rad);
                }
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("looks like radians where degrees were expected")));
}

TEST(Ruby128Calibration, NamesAnEmptyTable) {
  EXPECT_THAT(validated([](auto& c) { c.channels = {}; }),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("empty table")));
}

TEST(Ruby128Calibration, NamesSwappedColumns) {
  EXPECT_THAT(validated([](auto& c) {
                for (Ruby128Channel& channel : c.channels) {
                  std::swap(channel.elevation_rad, channel.azimuth_offset_rad);
                }
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("channel 1 "), HasSubstr("columns swapped"))));
}

TEST(Ruby128Calibration, NamesTwoChannelsOfOneElevation) {
  EXPECT_THAT(validated([](auto& c) {
                c.channels[40].elevation_rad =
                    c.channels[3].elevation_rad + beams::deg_to_rad(0.004);
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("channels 4 and 41"), HasSubstr("1.910 deg"))));
  EXPECT_TRUE(validated([](auto& c) {
                c.channels[40].elevation_rad =
                    c.channels[3].elevation_rad + beams::deg_to_rad(0.01);
              }).has_value());
}

TEST(Ruby128Calibration, RefusesATableWithoutAzimuthOffsets) {
  EXPECT_THAT(
      validated([](auto& c) {
        for (Ruby128Channel& channel : c.channels) channel.azimuth_offset_rad = 0;
        c.channels[10].azimuth_offset_rad = beams::deg_to_rad(-0.5);
        c.channels[20].azimuth_offset_rad = beams::deg_to_rad(0.5);
      }),
      calib::IsRefusedWith(ErrorCode::kMalformed,
                           HasSubstr("all azimuth offsets lie between -0.500 deg (channel 11) and "
                                     "0.500 deg (channel 21)")));
}

TEST(Ruby128Calibration, RefusesATableSortedByElevation) {
  const auto upwards = [](const Ruby128Channel& a, const Ruby128Channel& b) {
    return a.elevation_rad < b.elevation_rad;
  };
  EXPECT_THAT(validated([&](auto& c) { std::sort(c.channels.begin(), c.channels.end(), upwards); }),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("sorted table")));
  EXPECT_THAT(
      validated([&](auto& c) { std::sort(c.channels.rbegin(), c.channels.rend(), upwards); }),
      calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("sorted table")));
}

TEST(Ruby128Calibration, KnowsTheTableOfARubyPlus) {
  constexpr std::pair<double, double> kFirst_deg[] = {{-11.78, 5.94}, {-10.37, 2.39},
                                                      {-9.27, -1.15}, {-8.38, -4.69},
                                                      {-16.07, 4.70}, {-25.10, 1.17}};
  for (const double off_deg : {0.0, -0.05, 0.05}) {
    EXPECT_THAT(validated([&](auto& c) {
                  for (std::size_t i = 0; i < std::size(kFirst_deg); ++i) {
                    c.channels[i] = {beams::deg_to_rad(kFirst_deg[i].first + off_deg),
                                     beams::deg_to_rad(kFirst_deg[i].second - off_deg)};
                  }
                }),
                calib::IsRefusedWith(ErrorCode::kUnsupported, HasSubstr("RS-Ruby Plus")));
  }
  // One channel like a Plus's makes no Plus.
  EXPECT_TRUE(validated([&](auto& c) {
                c.channels[0] = {beams::deg_to_rad(kFirst_deg[0].first),
                                 beams::deg_to_rad(kFirst_deg[0].second)};
              }).has_value());
}

TEST(Ruby128Calibration, SaysNothingOfAnOriginItDoesNotKnow) {
  EXPECT_THAT(validated([](auto& c) {
                c.origin.clear();
                c.channels = {};
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed, Not(HasSubstr("from"))));
}

TEST(Ruby128Calibration, RoundsAnglesAsFilesAndPacketsDo) {
  EXPECT_EQ(angle_mdeg(beams::deg_to_rad(-13.565)), -13565);
  EXPECT_EQ(angle_mdeg(beams::deg_to_rad(-0.0004)), 0);
  EXPECT_EQ(angle_cdeg(beams::deg_to_rad(5.95)), 595);
  EXPECT_EQ(angle_cdeg(0.0), 0);
  // Halves away from zero, also where the radians fall short of the half in their last bit.
  for (int mdeg = -25'995; mdeg <= 15'995; mdeg += 10) {
    const double rad = beams::deg_to_rad(mdeg / 1000.0);
    for (const double near : {rad, std::nextafter(rad, -9.0), std::nextafter(rad, 9.0)}) {
      ASSERT_EQ(angle_cdeg(near), (mdeg < 0 ? mdeg - 5 : mdeg + 5) / 10) << mdeg;
    }
  }
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_EQ(angle_mdeg(bad), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(angle_cdeg(bad), std::numeric_limits<std::int64_t>::min());
  }
}

TEST(Ruby128Calibration, RowsRunFromTheLowestElevationToTheHighest) {
  const Ruby128Calibration calibration = nominal_ruby128();
  const auto rows = rows_by_elevation(calibration);
  std::array<double, kRuby128Lasers> elevation_rad;
  elevation_rad.fill(std::nan(""));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    elevation_rad[static_cast<std::size_t>(rows[i])] = calibration.channels[i].elevation_rad;
  }
  EXPECT_TRUE(std::none_of(elevation_rad.begin(), elevation_rad.end(),
                           [](double rad) { return std::isnan(rad); }));
  EXPECT_TRUE(std::is_sorted(elevation_rad.begin(), elevation_rad.end()));
}

TEST(Ruby128Calibration, EqualElevationsKeepTheOrderOfTheirChannels) {
  const auto rows = rows_by_elevation({});
  for (int i = 0; i < kRuby128Lasers; ++i) EXPECT_EQ(rows[static_cast<std::size_t>(i)], i);
}

TEST(Ruby128Calibration, FingerprintLooksAtEveryAngleButNotAtTheOrigin) {
  const std::uint64_t original = fingerprint(nominal_ruby128());
  const auto changed = [&](auto change) {
    Ruby128Calibration calibration = nominal_ruby128();
    change(calibration);
    return fingerprint(calibration) != original;
  };
  EXPECT_FALSE(changed([](auto& c) { c.origin = "elsewhere"; }));
  EXPECT_FALSE(changed([](auto& c) { c.nominal = false; }));
  for (std::size_t i = 0; i < kRuby128Lasers; ++i) {
    EXPECT_TRUE(changed([&](auto& c) { c.channels[i].elevation_rad += beams::deg_to_rad(0.01); }))
        << i;
    EXPECT_TRUE(changed([&](auto& c) {
      c.channels[i].azimuth_offset_rad += beams::deg_to_rad(0.01);
    })) << i;
  }
}

TEST(Ruby128Calibration, FingerprintIgnoresWhatDifopCannotCarry) {
  Ruby128Calibration rounded = nominal_ruby128();
  for (Ruby128Channel& channel : rounded.channels) {
    channel.elevation_rad =
        beams::deg_to_rad(static_cast<double>(angle_cdeg(channel.elevation_rad)) / 100.0);
    channel.azimuth_offset_rad =
        beams::deg_to_rad(static_cast<double>(angle_cdeg(channel.azimuth_offset_rad)) / 100.0);
  }
  EXPECT_NE(rounded.channels, nominal_ruby128().channels);
  EXPECT_EQ(fingerprint(rounded), fingerprint(nominal_ruby128()));
}

}  // namespace
}  // namespace terracut::ruby128
