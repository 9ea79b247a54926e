// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Packets that are made of an Ouster, read by the plain decoder written from the maker's
// documentation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "calib/ouster/ouster_geometry.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "tests/support/reference/ouster_reference.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/tools/lab/drive/made_drive.hpp"
#include "tests/tools/lab/drive/random_columns.hpp"
#include "tools/lab/drive/drive_writer.hpp"

namespace terracut::packets {
namespace {

using Made = OusterEncoderTraits<64>;

class OusterPackets : public test::InScratchFolder,
                      public testing::WithParamInterface<ouster::Profile> {};

TEST_P(OusterPackets, AreReadByASecondDecoderReturnByReturn) {
  ouster::OusterCalibration unit = Made::nominal();
  unit.format.profile = GetParam();
  const ReturnMode returns = unit.format.is_dual() ? ReturnMode::kDual : ReturnMode::kSingle;
  unit = Made::unit_in_mode(unit, returns, 10);
  ASSERT_EQ(unit.format.profile, GetParam());
  const auto columns = test::random_columns<Made>({.returns = returns, .share_of_returns = 0.3});
  const auto pcap = folder_ / "drive.pcap";
  auto writer = drive::DriveWriter<Made>::create(pcap, unit, {.returns = returns});
  ASSERT_TRUE(writer) << writer.error().message;
  for (const auto& column : columns) {
    ASSERT_TRUE(
        writer->add_column(column.stamp_ns, column.unwrapped_azimuth_cdeg, column.by_laser));
  }
  ASSERT_TRUE(writer->finish());

  const auto told = test::table_beside<Made>(pcap);
  ASSERT_TRUE(told) << told.error().message;
  EXPECT_EQ(fingerprint(*told), fingerprint(unit));
  EXPECT_EQ(told->format, unit.format);
  EXPECT_EQ(told->rate_hz, unit.rate_hz);
  const reference::OusterReference second(*told);
  const int count_mm = ouster::row_of(GetParam()).range_mm;
  auto source = capture::CaptureSource::open(pcap, {.port = ouster::kDataPort});
  ASSERT_TRUE(source);
  auto column = columns.begin();
  std::size_t wrong = 0, read = 0;
  for (auto next = source->next(); next && *next; next = source->next()) {
    const reference::Packet packet = second.decode((*next)->payload);
    ASSERT_EQ(packet.refusal, reference::Refusal::kNone);
    auto found = packet.returns.begin();
    for (int c = 0; c < packet.columns; ++c, ++column) {
      for (int laser = 0; laser < Made::kLasers; ++laser) {
        const LabelledReturn& made = column->by_laser[static_cast<std::size_t>(laser)];
        if (made.raw == 0) continue;
        ASSERT_NE(found, packet.returns.end());
        const int off_mm = found->raw_distance - made.raw * kOusterMillimetresPerCount;
        const bool is_same = found->column == c && found->laser == laser &&
                             2 * std::abs(off_mm) <= count_mm && found->intensity == made.intensity;
        wrong += is_same || made.raw < 4 ? 0 : 1;
        ++found;
        ++read;
      }
    }
    EXPECT_EQ(found, packet.returns.end());
  }
  EXPECT_EQ(column, columns.end());
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(read, 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Profiles, OusterPackets,
                         testing::Values(ouster::Profile::kLegacy, ouster::Profile::kSingle,
                                         ouster::Profile::kDual, ouster::Profile::kLowRate,
                                         ouster::Profile::kLowRateDual),
                         [](const auto& profile) {
                           std::string name;
                           for (const char c : ouster::row_of(profile.param).name) {
                             if (c != '_') name += c;
                           }
                           return name;
                         });

TEST(OusterGeometry, IsThatOfTheSecondDecoder) {
  std::mt19937 random(5);
  for (int n = 0; n < 20; ++n) {
    const ouster::OusterCalibration unit =
        reference::random_ouster(64, ouster::Profile::kSingle, random);
    constexpr int kCount_mm = 4;  // so that 16 bits reach as far as the ranges made here
    const ouster::OusterGeometry geometry(unit, kCount_mm * 1e-3);
    const reference::OusterReference second(unit);
    const auto payloads = reference::ouster_payloads(
        unit, {.packets = 4, .share_of_returns = 0.1, .seed = static_cast<unsigned>(n)});
    for (const reference::Payload& payload : payloads) {
      for (const reference::Return& found : second.decode(payload.bytes).returns) {
        const double azimuth_rad = beams::deg_to_rad(found.rotor_deg);
        const double counts_made = static_cast<double>(found.raw_distance) / kCount_mm;
        const beams::Point point = geometry.point(found.laser, azimuth_rad, counts_made);
        EXPECT_NEAR(point.x_m, found.x_m, 1e-9);
        EXPECT_NEAR(point.y_m, found.y_m, 1e-9);
        EXPECT_NEAR(point.z_m, found.z_m, 1e-9);
        const auto counts =
            geometry.raw_on_plane(found.laser, azimuth_rad, point, {0.3, 0.4, -0.2});
        ASSERT_TRUE(counts);
        EXPECT_NEAR(*counts, counts_made, 1e-3);
      }
    }
  }
}

TEST(OusterUnit, IsMadeInTheModeOfTheNearestRateOrItsOwn) {
  const auto nominal = Made::nominal();
  EXPECT_EQ(Made::unit_in_mode(nominal, ReturnMode::kSingle, 10).columns_per_frame, 1024);
  EXPECT_EQ(Made::unit_in_mode(nominal, ReturnMode::kSingle, 5).columns_per_frame, 4096);
  const auto dual = Made::unit_in_mode(nominal, ReturnMode::kDual, 19);
  EXPECT_EQ(dual.rate_hz, 20);
  EXPECT_EQ(dual.format.profile, ouster::Profile::kDual);
  ouster::OusterCalibration own = nominal;
  own.columns_per_frame = 2048;
  own.window = {100, 200};
  const auto whole = Made::unit_in_mode(own, ReturnMode::kSingle, 10);
  EXPECT_EQ(whole.columns_per_frame, 2048);
  EXPECT_EQ(whole.window[1], 2047);
}

}  // namespace
}  // namespace terracut::packets
