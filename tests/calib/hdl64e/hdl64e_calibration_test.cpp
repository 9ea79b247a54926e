// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::hdl64e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <class Change>
Status validated(Change change) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  calibration.origin = "unit.xml";
  change(calibration);
  return validate(calibration);
}

TEST(Hdl64eCalibration, AcceptsAPlausibleTable) {
  EXPECT_TRUE(validated([](Hdl64eCalibration&) {}).has_value());
}

TEST(Hdl64eCalibration, NamesOriginLaserFieldValueAndSpanOfABadValue) {
  const Status status = validated([](Hdl64eCalibration& c) { c.lasers[17].horiz_offset_m = 1.25; });
  EXPECT_THAT(status, calib::IsRefusedWith(ErrorCode::kMalformed,
                                           AllOf(HasSubstr("unit.xml"), HasSubstr("laser 17"),
                                                 HasSubstr("horizontal offset"),
                                                 HasSubstr("1.25 m"), HasSubstr("-1 to 1 m"))));
}

TEST(Hdl64eCalibration, RefusesNanAndInfinityInEveryField) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity(), 1e300}) {
    for (double Hdl64eLaser::* field :
         {&Hdl64eLaser::rot_correction_rad, &Hdl64eLaser::vert_correction_rad,
          &Hdl64eLaser::dist_correction_m, &Hdl64eLaser::dist_correction_x_m,
          &Hdl64eLaser::dist_correction_y_m, &Hdl64eLaser::vert_offset_m,
          &Hdl64eLaser::horiz_offset_m, &Hdl64eLaser::focal_distance_m,
          &Hdl64eLaser::focal_slope}) {
      EXPECT_FALSE(validated([&](Hdl64eCalibration& c) { c.lasers[63].*field = bad; }));
    }
    EXPECT_FALSE(validated([&](Hdl64eCalibration& c) { c.distance_resolution_m = bad; }));
  }
}

TEST(Hdl64eCalibration, NamesDegreesTakenForRadians) {
  const Status status = validated([](Hdl64eCalibration& c) {
    for (Hdl64eLaser& laser : c.lasers) {
      laser.vert_correction_rad = beams::rad_to_deg(laser.vert_correction_rad);
      laser.rot_correction_rad = beams::rad_to_deg(laser.rot_correction_rad);
    }
  });
  EXPECT_THAT(status,
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("looks like degrees where radians were expected")));
}

TEST(Hdl64eCalibration, NamesRadiansTakenForDegrees) {
  const Status status = validated([](Hdl64eCalibration& c) {
    for (Hdl64eLaser& laser : c.lasers) {
      laser.vert_correction_rad = beams::deg_to_rad(laser.vert_correction_rad);
    }
  });
  EXPECT_THAT(status,
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   HasSubstr("looks like radians where degrees were expected")));
}

TEST(Hdl64eCalibration, NamesCentimetresAndMillimetresTakenForMetres) {
  EXPECT_THAT(validated([](Hdl64eCalibration& c) {
                for (Hdl64eLaser& laser : c.lasers) laser.dist_correction_m *= 100;
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("looks like centimetres")));
  EXPECT_THAT(validated([](Hdl64eCalibration& c) {
                for (Hdl64eLaser& laser : c.lasers) laser.dist_correction_m *= 1000;
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed, HasSubstr("looks like millimetres")));
}

TEST(Hdl64eCalibration, RefusesTwoLasersOfOneElevation) {
  const Status status = validated([](Hdl64eCalibration& c) {
    c.lasers[40].vert_correction_rad = c.lasers[3].vert_correction_rad;
  });
  EXPECT_THAT(status,
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("lasers 3 and 40"), HasSubstr("distinct"))));
}

TEST(Hdl64eCalibration, RefusesATwoPointCorrectionFarFromTheFarOne) {
  EXPECT_THAT(
      validated([](Hdl64eCalibration& c) { c.lasers[8].dist_correction_y_m = 0; }),
      calib::IsRefusedWith(ErrorCode::kMalformed,
                           AllOf(HasSubstr("laser 8"), HasSubstr("correction Y (two-point)"))));
}

TEST(Hdl64eCalibration, RefusesAnIntensityRangeThatIsUpsideDown) {
  EXPECT_THAT(validated([](Hdl64eCalibration& c) {
                c.lasers[5].min_intensity = 90;
                c.lasers[5].max_intensity = 80;
              }),
              calib::IsRefusedWith(ErrorCode::kMalformed,
                                   AllOf(HasSubstr("laser 5"), HasSubstr("maximum intensity"))));
}

TEST(Hdl64eCalibration, TwoPointNeedsANearValueThatIsNotZeroAndNotFar) {
  EXPECT_TRUE(two_point_present(1.2, 1.25, 1.2));
  EXPECT_TRUE(two_point_present(1.2, 1.2, 1.25));
  EXPECT_FALSE(two_point_present(1.2, 1.2, 1.2));
  EXPECT_FALSE(two_point_present(1.2, 0, 0));
  EXPECT_FALSE(two_point_present(1.2, 0, 1.2));
}

TEST(Hdl64eCalibration, RowsAscendInElevationAndAreAPermutation) {
  const Hdl64eCalibration calibration = nominal_hdl64e();
  const auto rows = rows_by_elevation(calibration);
  std::array<double, kHdl64eLasers> elevation{};
  elevation.fill(std::nan(""));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    elevation[static_cast<std::size_t>(rows[i])] = calibration.lasers[i].vert_correction_rad;
  }
  EXPECT_TRUE(std::none_of(elevation.begin(), elevation.end(), [](double e) { return e != e; }));
  EXPECT_TRUE(std::is_sorted(elevation.begin(), elevation.end()));
}

TEST(Hdl64eCalibration, EqualElevationsKeepTheOrderOfTheirLasers) {
  Hdl64eCalibration calibration;  // all elevations 0
  const auto rows = rows_by_elevation(calibration);
  for (int i = 0; i < kHdl64eLasers; ++i) EXPECT_EQ(rows[static_cast<std::size_t>(i)], i);
}

TEST(Hdl64eCalibration, FingerprintLooksAtEveryValueButNotAtTheOrigin) {
  const std::uint64_t original = fingerprint(nominal_hdl64e());
  const auto changed = [&](auto change) {
    Hdl64eCalibration calibration = nominal_hdl64e();
    change(calibration);
    return fingerprint(calibration) != original;
  };
  EXPECT_FALSE(changed([](auto& c) { c.origin = "elsewhere"; }));
  EXPECT_TRUE(changed([](auto& c) { c.distance_resolution_m = 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].vert_correction_rad += beams::deg_to_rad(0.01); }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].rot_correction_rad += beams::deg_to_rad(0.01); }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].dist_correction_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].dist_correction_x_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].dist_correction_y_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].vert_offset_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].horiz_offset_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].focal_distance_m += 0.001; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].focal_slope += 0.1; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].min_intensity += 1; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].max_intensity -= 1; }));
  EXPECT_TRUE(changed([](auto& c) { c.lasers[1].two_point = false; }));
}

TEST(Hdl64eCalibration, FingerprintIgnoresWhatTheStreamCannotCarry) {
  Hdl64eCalibration calibration = nominal_hdl64e();
  for (Hdl64eLaser& laser : calibration.lasers) {
    laser.vert_correction_rad += beams::deg_to_rad(0.004);
    laser.dist_correction_m -= 0.0004;
    laser.focal_slope += 0.04;
  }
  EXPECT_EQ(fingerprint(calibration), fingerprint(nominal_hdl64e()));
}

}  // namespace
}  // namespace terracut::hdl64e
