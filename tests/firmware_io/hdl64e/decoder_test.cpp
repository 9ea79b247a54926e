// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "random_drive.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/places.hpp"
#include "tests/support/reference/agreement.hpp"
#include "tests/support/reference/hdl64e_reference.hpp"

namespace terracut::test {
namespace {

using frame::Reject;

/// Decodes the packets both ways and compares return by return, in order of arrival.
void expect_same_returns(std::span<const Packet> packets,
                         const hdl64e::Hdl64eCalibration& calibration,
                         const Recorder::Config& config = {}) {
  const mount::Mount mount{.height_m = 1.9, .roll_rad = -0.02, .pitch_rad = 0.04};
  std::vector<double> elevations;
  for (const auto& laser : calibration.lasers) elevations.push_back(laser.vert_correction_rad);
  const bool ros_like = config.hdl64e.geometry == hdl64e::GeometryModel::kRosLike;
  const reference::Hdl64eReference reference(calibration, ros_like
                                                              ? reference::Hdl64eOffsets::kRosLike
                                                              : reference::Hdl64eOffsets::kManual);
  Recorder recorder(config, calibration, mount);
  const int columns = recorder.decoder.shape().columns;
  reference::ExpectedFrames expected(elevations, mount, columns);
  reference::Frames frames;
  reference::HandedFrames handed;
  for (const Packet& packet : packets) {
    const reference::Packet plain = reference.decode(packet.bytes);
    ASSERT_EQ(plain.refusal, reference::Refusal::kNone);
    for (const reference::Return& seen : plain.returns) {
      ASSERT_GT(reference::seam_distance_deg(seen.beam_deg), reference::kBorder_deg)
          << "choose another seed";
    }
    expected.add(plain, frames.unwrap(plain));
    ASSERT_FALSE(test::decode(recorder.decoder, packet.datagram(), handed.keep()));
  }
  test::end_stream(recorder.decoder, handed.keep());
  EXPECT_GT(handed.returns(), 0U);
  EXPECT_EQ(recorder.decoder.columns_decoded(),
            recorder.decoder.packets_decoded() * hdl64e::kColumnsPerPacketSingle);
  EXPECT_EQ(reference::first_difference(expected, handed, columns), "");
}

TEST(Hdl64eDecoder, AgreesWithAPlainSlowDecoder) {
  expect_same_returns(random_packets(), hdl64e::nominal_hdl64e());
}

TEST(Hdl64eDecoder, AgreesWithAPlainSlowDecoderInTheRosLikeGeometry) {
  Recorder::Config config;
  config.hdl64e.geometry = hdl64e::GeometryModel::kRosLike;
  expect_same_returns(random_packets({.seed = 2}), hdl64e::nominal_hdl64e(), config);
}

class SpinRate : public testing::TestWithParam<double> {};

TEST_P(SpinRate, AgreesWithAPlainSlowDecoder) {
  const double hertz = GetParam();
  Recorder::Config config;
  config.columns = static_cast<int>(std::lround(1e6 / 48.0 / hertz));
  expect_same_returns(random_packets({.step_deg = 360.0 * hertz * 48e-6, .seed = 11}),
                      hdl64e::nominal_hdl64e(), config);
}

INSTANTIATE_TEST_SUITE_P(Hertz, SpinRate, testing::Values(5.0, 7.3, 10.0, 15.0, 20.0));

TEST(Hdl64eDecoder, KeepsEveryReturnWhenTheImageIsTooNarrow) {
  // 5 Hz: 4167 firings into 2083 columns; each cell gets two returns.
  expect_same_returns(random_packets({.last_cdeg = 80'000, .step_deg = 0.0864, .seed = 4}),
                      hdl64e::nominal_hdl64e());
}

TEST(Hdl64eDecoder, TakesWideRotationalCorrections) {
  hdl64e::Hdl64eCalibration calibration = hdl64e::nominal_hdl64e();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any_deg(-10, 10);
  for (auto& laser : calibration.lasers) {
    laser.rot_correction_rad = beams::deg_to_rad(any_deg(random));
  }
  calibration.lasers[0].rot_correction_rad = beams::deg_to_rad(10.0);
  calibration.lasers[1].rot_correction_rad = beams::deg_to_rad(-10.0);
  expect_same_returns(random_packets({.seed = 12}), calibration);
}

class RealUnits : public testing::TestWithParam<const char*> {};

TEST_P(RealUnits, AgreeWithAPlainSlowDecoder) {
  const auto path = test::shared_data("calib") / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto calibration = hdl64e::load_hdl64e_calibration(path);
  ASSERT_TRUE(calibration) << calibration.error().message;
  expect_same_returns(random_packets({.seed = 21}), *calibration);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealUnits,
                         testing::Values("64e_s2.1-sztaki.xml", "64e_s3-xiesc.yaml",
                                         "64e_utexas.yaml"),
                         [](const auto& case_info) {
                           std::string name = case_info.param;
                           for (char& c : name) {
                             if (c == '.' || c == '-') c = '_';
                           }
                           return name;
                         });

TEST(Hdl64eDecoder, ReadsTheBytesOfTheFormatsDescription) {
  // Distance bytes 10 27 are 20.000 m, azimuth bytes 9F 8C are 359.99 degrees.
  std::vector<FiringColumn> firings(6);
  for (std::size_t c = 0; c < 6; ++c) {
    firings[c].unwrapped_azimuth_cdeg = 35'999 - 85 + 17 * static_cast<std::int64_t>(c);
    firings[c].stamp_ns = 48'000 * static_cast<std::int64_t>(c);
  }
  firings[5].by_laser[0] = {10'000, 77, 0};
  const std::vector<Packet> packets = to_packets(firings);
  EXPECT_EQ(packets[0].bytes[1000], 0xFF);
  EXPECT_EQ(packets[0].bytes[1001], 0xEE);
  EXPECT_EQ(packets[0].bytes[1002], 0x9F);
  EXPECT_EQ(packets[0].bytes[1003], 0x8C);
  EXPECT_EQ(packets[0].bytes[1004], 0x10);
  EXPECT_EQ(packets[0].bytes[1005], 0x27);
  EXPECT_EQ(packets[0].bytes[1100], 0xFF);
  EXPECT_EQ(packets[0].bytes[1101], 0xDD);

  hdl64e::Hdl64eCalibration flat;  // all corrections 0
  Recorder recorder(packets, {}, flat, {.height_m = 1.0});
  ASSERT_EQ(recorder.frames.size(), 1U);
  ASSERT_EQ(recorder.frames[0].returns.size(), 1U);
  const Frame::Placed& placed = recorder.frames[0].returns[0];
  EXPECT_NEAR(placed.point.x_m, 20.0 * std::cos(beams::deg_to_rad(0.01)), 1e-5);
  EXPECT_NEAR(placed.point.y_m, 20.0 * std::sin(beams::deg_to_rad(0.01)), 1e-5);
  EXPECT_NEAR(placed.point.z_m, 1.0, 1e-6);
  EXPECT_NEAR(placed.point.ground_range_m, 20.0, 1e-5);
  EXPECT_EQ(placed.point.intensity, 77);
  EXPECT_EQ(placed.column, 2082U);
}

TEST(Hdl64eDecoder, HandsOverEachFrameOnceInOrderAndWhole) {
  // From 11 degrees before a seam to 13 after the third.
  const auto packets = random_packets({.last_cdeg = 37'300 + 2 * 36'000});
  Recorder recorder;
  recorder.decode_all(packets);
  // The last frame is handed over in the stream, not only by flush().
  EXPECT_EQ(recorder.frames.size(), 3U);
  recorder.flush();
  ASSERT_EQ(recorder.frames.size(), 4U);
  for (std::uint32_t n = 0; n < 4; ++n) EXPECT_EQ(recorder.frames[n].info.number, n);
  // Lasers point both ways, so a little of the frames before and after was seen, too.
  EXPECT_FALSE(recorder.frames[0].info.complete);
  EXPECT_TRUE(recorder.frames[1].info.complete);
  EXPECT_TRUE(recorder.frames[2].info.complete);
  EXPECT_FALSE(recorder.frames[3].info.complete);
  for (const Frame& frame : recorder.frames) {
    EXPECT_EQ(frame.info.losses.network_gap_packets, 0U);
    EXPECT_EQ(frame.info.losses.azimuth_hole_columns, 0U);
    EXPECT_EQ(frame.info.losses.rejected_total(), 0U);
  }
  EXPECT_EQ(recorder.decoder.packets_decoded(), packets.size());
  EXPECT_NEAR(static_cast<double>(recorder.decoder.packet_period_ns()), 288'000, 100);
}

TEST(Hdl64eDecoder, FramesWithoutReturnsAreNoFrames) {
  auto firings = random_firings({});
  for (auto& firing : firings) {
    if (firing.unwrapped_azimuth_cdeg < 72'000) firing.by_laser = {};
  }
  Recorder recorder(to_packets(firings));
  // The head's third frame from the start, what of it leads and trails, and no empty ones.
  ASSERT_EQ(recorder.frames.size(), 3U);
  EXPECT_EQ(recorder.frames[0].info.number, 0U);
  EXPECT_EQ(recorder.returns(), [&] {
    std::uint64_t sum = 0;
    for (const auto& firing : firings) {
      for (const auto& beam : firing.by_laser) sum += beam.raw != 0;
    }
    return sum;
  }());
}

TEST(Hdl64eDecoder, RotatesLaterLasersOn) {
  std::vector<FiringColumn> firings(6);
  for (std::size_t c = 0; c < 6; ++c) {
    firings[c].unwrapped_azimuth_cdeg = 9'000 + 20 * static_cast<std::int64_t>(c);
    firings[c].stamp_ns = 48'000 * static_cast<std::int64_t>(c);
  }
  firings[0].by_laser[31] = {10'000, 0, 0};
  hdl64e::Hdl64eCalibration flat;
  Recorder recorder(to_packets(firings), {}, flat);
  const frame::Return& point = recorder.frames.at(0).returns.at(0).point;
  // The last group of four fires 42 us into the 48 us, its last laser 3.66 us later.
  EXPECT_NEAR(beams::rad_to_deg(std::atan2(-point.y_m, point.x_m)), 90.0 + 0.20 * 45.66 / 48.0,
              1e-4);
}

TEST(Hdl64eDecoder, PlacesBothReturnsOfADualReturnPacket) {
  // Three firings a packet, each twice: strongest, then last.
  std::vector<FiringColumn> firings;
  for (int n = 0; n < 900; ++n) {
    for (int second = 0; second < 2; ++second) {
      FiringColumn& firing = firings.emplace_back();
      firing.unwrapped_azimuth_cdeg = 18'000 + 20 * n;
      firing.stamp_ns = 57'600 * n + second * 28'800;
      firing.by_laser.fill({static_cast<std::uint16_t>(5'000 + 1'000 * second), 1, 0});
    }
  }
  Recorder::Config config;
  config.columns = 1736;
  Recorder recorder(config);
  recorder.decode_all(to_packets(firings));
  EXPECT_TRUE(recorder.decoder.dual_return());
  EXPECT_NEAR(static_cast<double>(recorder.decoder.packet_period_ns()), 172'800, 1'000);
  recorder.flush();
  EXPECT_EQ(recorder.returns(), 900U * 128U);
  const auto losses = recorder.decoder.losses();
  EXPECT_EQ(losses.rejected_total() + losses.overflow_full_returns + losses.azimuth_hole_columns +
                losses.network_gap_packets,
            0U);
}

TEST(Hdl64eDecoder, InSingleReturnACellStaysWithTheFirstToArrive) {
  // Two firings in one column of a narrow image, the second one stronger.
  std::vector<FiringColumn> firings(6);
  for (std::size_t c = 0; c < 6; ++c) {
    firings[c].unwrapped_azimuth_cdeg = 9'001 + 17 * static_cast<std::int64_t>(c);
    firings[c].stamp_ns = 48'000 * static_cast<std::int64_t>(c);
  }
  firings[0].by_laser[0] = {10'000, 10, 0};
  firings[1].by_laser[0] = {5'000, 200, 0};
  Recorder::Config config;
  config.columns = 360;
  config.dual_owner = frame::CellOwner::kStrongest;
  Recorder recorder(to_packets(firings), config, hdl64e::Hdl64eCalibration{});
  ASSERT_EQ(recorder.returns(), 2U);
  const std::vector<Frame::Placed>& returns = recorder.frames.at(0).returns;
  EXPECT_EQ(returns[0].column, returns[1].column);
  EXPECT_EQ(returns[0].point.intensity, 10);
  EXPECT_FALSE(returns[0].overflow);
  EXPECT_TRUE(returns[1].overflow);
}

TEST(Hdl64eDecoder, ARestartAtAnotherSpinRateResetsTheStepBefore) {
  const auto slow = random_packets({.last_cdeg = 34'900 + 3 * 36'000, .step_deg = 0.0864});
  auto fast = random_packets({.step_deg = 0.3456});
  fast.erase(fast.begin() + 50, fast.begin() + 52);
  Recorder recorder(slow);
  recorder.decode_all(fast);
  recorder.flush();
  EXPECT_EQ(recorder.decoder.losses().azimuth_hole_columns, 12U);
}

TEST(Hdl64eDecoder, RefusesSettingsOutsideTheirRange) {
  Recorder::Config config;
  config.columns = 15;
  EXPECT_THROW(Recorder{config}, std::invalid_argument);
  config.columns = 36'001;
  EXPECT_THROW(Recorder{config}, std::invalid_argument);
}

}  // namespace
}  // namespace terracut::test
