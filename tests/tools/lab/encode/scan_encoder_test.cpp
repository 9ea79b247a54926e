// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/scan_encoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"
#include "tools/lab/encode/recorded_spin.hpp"

namespace terracut::encode {
namespace {

/// Decodes firings by the reference geometry and checks them against the scans they came from.
class RoundTrip {
 public:
  RoundTrip(const hdl64e::Hdl64eCalibration& calibration,
            std::vector<std::vector<scan::ScanPoint>> scans)
      : calibration_(calibration), geometry_(calibration), scans_(std::move(scans)) {
    scan::RingRecovery rings;
    const scan::RingTable table = synthetic::table();
    RecordedSpin spin;
    for (const auto& scan : scans_) {
      EXPECT_TRUE(scan::recover_rings(scan, &table, rings));
      spin.add(rings.ring_of_point);
    }
    firings_a_frame = spin.firings();
    ScanEncoder encoder(calibration, {std::ssize(scans_), spin.spin_hz(), 1000},
                        [this](const EncodedFiring& firing) -> Status {
                          firings_.push_back(firing);
                          return {};
                        });
    for (const auto& scan : scans_) {
      EXPECT_TRUE(scan::recover_rings(scan, &table, rings));
      std::vector<std::uint32_t> labels(scan.size());
      std::iota(labels.begin(), labels.end(), 0U);
      EXPECT_TRUE(encoder.add_frame(scan, rings.ring_of_point, labels));
      seen_.emplace_back(scan.size());
    }
    auto finished = encoder.finish();
    EXPECT_TRUE(finished);
    if (finished) summary = *finished;
    decode();
  }

  EncodeSummary summary;
  std::size_t returns = 0;
  double max_range_error_m = 0;
  double max_height_error_m = 0;
  int firings_a_frame = 0;
  std::vector<double> azimuth_shift_deg;      ///< Of all returns.
  std::vector<double> max_azimuth_shift_deg;  ///< Of each frame.

  [[nodiscard]] const std::vector<EncodedFiring>& firings() const { return firings_; }
  [[nodiscard]] std::size_t not_encoded(NotEncoded reason) const {
    return summary.not_encoded[static_cast<std::size_t>(reason)];
  }
  /// Two-point corrections turn a beam a little with its distance.
  [[nodiscard]] double azimuth_bound_deg() const {
    return ScanEncoder::kFarthest_steps * 360.0 / firings_a_frame + 0.01;
  }

 private:
  void decode() {
    ASSERT_EQ(firings_.size() % 6, 0U);
    max_azimuth_shift_deg.resize(scans_.size());
    const hdl64e::BeamOffsets offsets(calibration_);
    for (std::size_t i = 0; i < firings_.size(); ++i) {
      const std::size_t packet = i / 6 * 6;
      const auto wire = [&](std::size_t f) {
        return beams::wrap_cdeg(firings_[f].column.unwrapped_azimuth_cdeg);
      };
      const auto step = hdl64e::column_step_ticks(wire(packet), wire(packet + 5));
      for (int laser = 0; laser < 64; ++laser) check(firings_[i], laser, step, offsets);
    }
  }

  void check(const EncodedFiring& firing, int laser, std::int32_t step,
             const hdl64e::BeamOffsets& offsets) {
    const auto& labelled = firing.column.by_laser[static_cast<std::size_t>(laser)];
    const auto& source = firing.sources[static_cast<std::size_t>(laser)];
    if (labelled.raw == 0) {
      EXPECT_EQ(source.frame, -1);
      return;
    }
    ++returns;
    const auto frame = static_cast<std::size_t>(source.frame);
    EXPECT_EQ(labelled.truth, source.point);
    EXPECT_EQ(seen_[frame][source.point]++, 0) << "a point encoded twice";
    const auto column = firing.column.unwrapped_azimuth_cdeg;
    const auto beam = packet::beam_azimuth(column, offsets.offset_ticks(step, laser));
    EXPECT_EQ(beam.frame, source.frame + 1) << "a return in another frame than its scan's";
    const double head =
        packet::firing_azimuth_rad(column, hdl64e::firing_advance_ticks(step, laser));
    const beams::Point hit = geometry_.point(laser, head, labelled.raw);
    const scan::ScanPoint& p = scans_[frame][source.point];
    const double range =
        std::sqrt(double{p.x_m} * p.x_m + double{p.y_m} * p.y_m + double{p.z_m} * p.z_m);
    const double decoded = std::sqrt(hit.x_m * hit.x_m + hit.y_m * hit.y_m + hit.z_m * hit.z_m);
    max_range_error_m = std::max(max_range_error_m, std::abs(decoded - range));
    max_height_error_m = std::max(max_height_error_m, std::abs(hit.z_m - double{p.z_m}));
    const double off = std::abs(
        std::remainder(scan::azimuth_rad(hit.x_m, hit.y_m) - scan::azimuth_rad(p.x_m, p.y_m),
                       2 * std::numbers::pi));
    azimuth_shift_deg.push_back(beams::rad_to_deg(off));
    max_azimuth_shift_deg[frame] = std::max(max_azimuth_shift_deg[frame], beams::rad_to_deg(off));
  }

  hdl64e::Hdl64eCalibration calibration_;
  hdl64e::Hdl64eGeometry geometry_;
  std::vector<std::vector<scan::ScanPoint>> scans_;
  std::vector<EncodedFiring> firings_;
  std::vector<std::vector<int>> seen_;
};

TEST(ScanEncoder, GivesEveryPointAReturnWithItsRangeAndHeight) {
  const scan::RingTable table = synthetic::table();
  const RoundTrip trip(scan::hdl64e_calibration(table), {synthetic::scan(table)});
  EXPECT_EQ(trip.summary.points, 128000U);
  EXPECT_EQ(trip.returns, trip.summary.encoded);
  EXPECT_EQ(trip.summary.encoded, 128000U);
  EXPECT_LE(trip.max_range_error_m, 0.0011);
  EXPECT_LE(trip.max_height_error_m, 0.001);  // the table is the scan's own
  EXPECT_LE(trip.max_azimuth_shift_deg[0], trip.azimuth_bound_deg());
}

TEST(ScanEncoder, MakesConsecutiveScansConsecutiveFrames) {
  const scan::RingTable table = synthetic::table();
  synthetic::World other;
  other.ground_m = -1.6;
  other.points_per_ring = 2140;
  other.first_azimuth_deg = 0.11;
  const RoundTrip trip(
      scan::hdl64e_calibration(table),
      {synthetic::scan(table), synthetic::scan(table, other), synthetic::scan(table)});
  ASSERT_EQ(trip.summary.frames.size(), 3U);
  EXPECT_EQ(trip.summary.points, 2U * 128000U + 64U * 2140U);
  EXPECT_EQ(trip.summary.encoded, trip.summary.points);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    EXPECT_LE(trip.max_azimuth_shift_deg[frame], trip.azimuth_bound_deg());
  }
}

TEST(ScanEncoder, ObeysAnyCalibrationWithWideRotationsAndTwoPointCorrections) {
  const scan::RingTable table = synthetic::table();
  const RoundTrip trip(hdl64e::nominal_hdl64e(), {synthetic::scan(table), synthetic::scan(table)});
  EXPECT_EQ(trip.returns, trip.summary.encoded);
  EXPECT_GE(trip.summary.encoded, trip.summary.points * 998 / 1000);
  EXPECT_LE(trip.max_range_error_m, 0.003);
  for (std::size_t frame = 0; frame < 2; ++frame) {
    EXPECT_LE(trip.max_azimuth_shift_deg[frame], trip.azimuth_bound_deg());
  }
}

TEST(ScanEncoder, TellsTheSameErrorsAsAnIndependentDecoding) {
  const scan::RingTable table = synthetic::table();
  const RoundTrip trip(hdl64e::nominal_hdl64e(), {synthetic::scan(table)});
  EXPECT_NEAR(trip.summary.max_range_error_m, trip.max_range_error_m, 1e-9);
  EXPECT_NEAR(trip.summary.max_azimuth_shift_deg, trip.max_azimuth_shift_deg[0], 1e-9);
  EXPECT_NEAR(trip.summary.frames[0].max_azimuth_shift_deg, trip.max_azimuth_shift_deg[0], 1e-9);
  std::vector<double> shift_deg = trip.azimuth_shift_deg;
  std::ranges::sort(shift_deg);
  EXPECT_NEAR(trip.summary.median_azimuth_shift_deg, shift_deg[shift_deg.size() / 2], 0.001);
  EXPECT_GT(trip.summary.height.p95_m, 0.01);  // another unit's table bends the scan
  EXPECT_LE(trip.summary.height.rms_m, trip.max_height_error_m);
}

TEST(ScanEncoder, AccountsForEveryPointItCannotEncode) {
  const scan::RingTable table = synthetic::table();
  auto points = synthetic::scan(table);
  points[10].x_m = std::numeric_limits<float>::quiet_NaN();
  points[20] = {140, 12, 5, 0};           // beyond the wire's 131 m
  points[30] = {0.0005F, 0.0001F, 0, 0};  // inside the first count
  // Ten points in one place: firings are had by those that need not move too far.
  for (std::size_t i = 0; i < 9; ++i) points[101 + i] = points[100];
  const RoundTrip trip(scan::hdl64e_calibration(table), {points});
  EXPECT_EQ(trip.not_encoded(NotEncoded::kNoPlace), 1U);
  EXPECT_EQ(trip.not_encoded(NotEncoded::kTooFar), 1U);
  EXPECT_EQ(trip.not_encoded(NotEncoded::kTooNear), 1U);
  EXPECT_GE(trip.not_encoded(NotEncoded::kCollision), 1U);
  const auto lost = std::accumulate(trip.summary.not_encoded.begin(),
                                    trip.summary.not_encoded.end(), std::size_t{0});
  EXPECT_EQ(trip.summary.encoded + lost, trip.summary.points);
}

TEST(ScanEncoder, CountsPointsWithoutARing) {
  const scan::RingTable table = synthetic::table();
  const auto points = synthetic::scan(table);
  std::vector<std::int16_t> rings(points.size(), scan::kNoRing);
  ScanEncoder encoder(scan::hdl64e_calibration(table), {},
                      [](const EncodedFiring&) -> Status { return {}; });
  ASSERT_TRUE(encoder.add_frame(points, rings, {}));
  const auto summary = encoder.finish();
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->encoded, 0U);
  EXPECT_EQ(summary->not_encoded[static_cast<std::size_t>(NotEncoded::kUnknownRing)],
            points.size());
}

TEST(ScanEncoder, RotatesTheHeadSteadilyFromBeforeTheFirstSeamToBehindTheLast) {
  const scan::RingTable table = synthetic::table();
  synthetic::World world;
  world.points_per_ring = 2160;
  const RoundTrip trip(hdl64e::nominal_hdl64e(), {synthetic::scan(table, world)});
  const auto& firings = trip.firings();
  EXPECT_LE(firings.front().column.unwrapped_azimuth_cdeg, 36000 - 1050);
  EXPECT_GE(firings.back().column.unwrapped_azimuth_cdeg, 72000 + 1050);
  for (std::size_t i = 1; i < firings.size(); ++i) {
    const auto step =
        firings[i].column.unwrapped_azimuth_cdeg - firings[i - 1].column.unwrapped_azimuth_cdeg;
    ASSERT_GE(step, 16);  // 36000 / 2160 is 16.7
    ASSERT_LE(step, 17);
    ASSERT_EQ(firings[i].column.stamp_ns - firings[i - 1].column.stamp_ns, 48000);
  }
}

TEST(ScanEncoder, HandsOnTheErrorOfItsSink) {
  const scan::RingTable table = synthetic::table();
  ScanEncoder encoder(scan::hdl64e_calibration(table), {}, [](const EncodedFiring&) -> Status {
    return fail(ErrorCode::kWriteFailed, "disk full");
  });
  const auto points = synthetic::scan(table);
  scan::RingRecovery rings;
  ASSERT_TRUE(scan::recover_rings(points, nullptr, rings));
  const Status first = encoder.add_frame(points, rings.ring_of_point, {});
  const auto last = encoder.finish();
  ASSERT_FALSE(last);
  EXPECT_EQ(last.error().message, "disk full");
}

}  // namespace
}  // namespace terracut::encode
