// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Velodyne's models with a built-in table: streams made here and real captures (data not part of
// the project; skipped where absent) beside a plain decoder written from the manuals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <random>

#include "tests/support/capture_payloads.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/places.hpp"
#include "tests/support/reference/decode_beside.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::reference {
namespace {

/// Degrees to add to the packet's azimuths where packets may be half a frame apart.
double unwrap_by_time(const std::vector<Payload>& payloads, const Payload& payload,
                      const Packet& packet, double spin_hz) {
  const auto stamp_us = [](const Payload& of) {
    double value_us = 0;
    for (std::size_t at = 1203; at >= 1200; --at) value_us = value_us * 256 + of.bytes[at];
    return value_us;
  };
  const double first_deg = (payloads[0].bytes[2] + 256 * payloads[0].bytes[3]) * 0.01;
  const double turned_deg = 360 * spin_hz * (stamp_us(payload) - stamp_us(payloads[0])) * 1e-6;
  return 360 * std::round((first_deg + turned_deg - packet.first_deg) / 360);
}

template <class Sensor>
class VelodyneStream : public testing::Test {};
template <class... Model>
using SensorsOf = testing::Types<Velodyne<Model>...>;
using Sensors = velodyne::Models::In<SensorsOf>;
TYPED_TEST_SUITE(VelodyneStream, Sensors);

TYPED_TEST(VelodyneStream, OfAModelThatWasNamedIsBelievedWhateverItsFactoryBytes) {
  if (TypeParam::kLasers == 128) GTEST_SKIP() << "its blocks tell it";
  velodyne::PacketReader reader(TypeParam::layout(), true);
  for (const bool dual_return : {false, true}) {
    auto bytes = TypeParam::payloads({.dual_return = dual_return, .packets = 1})[0].bytes;
    bytes[1204] = 0;
    for (const std::uint8_t product : {std::uint8_t{0x00}, std::uint8_t{0x23}}) {
      bytes[1205] = product;
      packet::PacketAzimuths azimuths;
      EXPECT_EQ(reader.read(bytes, azimuths), std::nullopt);
      EXPECT_EQ(azimuths.dual_return, dual_return);
    }
    bytes[1205] = 0x24;  // a VLP-16 Hi-Res says what it is
    packet::PacketAzimuths azimuths;
    EXPECT_EQ(reader.read(bytes, azimuths), frame::Reject::kWrongModel);
  }
}

TYPED_TEST(VelodyneStream, RefusesWhatIsNoDataPacketOfTheModel) {
  velodyne::PacketReader reader(TypeParam::layout());
  const auto good = TypeParam::payloads({.packets = 1})[0].bytes;
  packet::PacketAzimuths azimuths;
  const auto read = [&](std::size_t at, int value) {
    PayloadBytes bytes = good;
    bytes[at] = static_cast<std::uint8_t>(value);
    return reader.read(bytes, azimuths);
  };
  EXPECT_EQ(reader.read(good, azimuths), std::nullopt);
  EXPECT_EQ(read(1204, 0x38), std::nullopt);                // last return
  EXPECT_EQ(read(1204, 0x3A), frame::Reject::kWrongMagic);  // dual return with confidence
  // Dual return has pairs; the VLS-128 orders its blocks by them, and is told by its blocks.
  const bool is_vls128 = TypeParam::kLasers == 128;
  EXPECT_EQ(read(1204, 0x39),
            is_vls128 ? frame::Reject::kWrongMagic : frame::Reject::kAzimuthMismatch);
  EXPECT_EQ(read(1205, 0x77), is_vls128 ? std::nullopt : std::optional(frame::Reject::kWrongModel));
  EXPECT_EQ(read(103, 0xA0), frame::Reject::kAzimuthOutOfRange);
  EXPECT_EQ(reader.read(std::span(good).first(1205), azimuths), frame::Reject::kWrongSize);
  const PayloadBytes position(512, 0);
  EXPECT_EQ(reader.read(position, azimuths), frame::Reject::kDeviceInfo);
  const PayloadBytes nothing(1206, 0);
  EXPECT_EQ(reader.read(nothing, azimuths), frame::Reject::kWrongMagic);
}

// --- Real captures ---

struct RealCapture {
  const char* file;
  sensor::SensorModel model;
  std::uint64_t packets, returns;
  bool dual_return;
  std::size_t frames;  ///< By hand: seams that the head passes, and one.
};

class RealVelodyne : public testing::TestWithParam<RealCapture> {};

TEST_P(RealVelodyne, EqualsAPlainSlowDecoderAndLosesNothing) {
  const auto path = test::shared_data("pcap") / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto payloads = test::payloads_of(path, 2368);
  ASSERT_EQ(payloads.size(), GetParam().packets);
  const beams::BeamTable table = beams::built_in_table(GetParam().model);
  const Beside both =
      decode_beside<VelodyneReference>(payloads, table, elevations_of(table.lasers), 1808);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.returns, GetParam().returns);
  EXPECT_EQ(both.decoded, GetParam().packets);
  EXPECT_EQ(both.frames.size(), GetParam().frames);
  EXPECT_EQ(both.dual_return, GetParam().dual_return);
  EXPECT_EQ(both.losses.rejected_total(), 0U);
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
  EXPECT_EQ(both.losses.overflow_full_returns, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealVelodyne,
    testing::Values(
        RealCapture{"sample_velodyne_vlp16_gps.pcap", sensor::SensorModel::kVlp16, 293, 73'486,
                    false, 5},
        RealCapture{"vlp16_nebula.pcap", sensor::SensorModel::kVlp16, 603, 116'827, true, 5},
        RealCapture{"sample_velodyne_hdl32.pcap", sensor::SensorModel::kHdl32e, 500, 146'705, false,
                    4},
        RealCapture{"vls128_nebula.pcap", sensor::SensorModel::kVls128, 2193, 765'932, false, 5}),
    [](const auto& capture) {
      std::string name = capture.param.file;
      return name.substr(0, name.find('.'));
    });

TEST(RealVlp32c, IsDecodedOnBothSidesOfItsBlindSector) {
  const auto path = test::shared_data("pcap") / "vlp32_nebula.pcap";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto payloads = test::payloads_of(path, 2368);
  ASSERT_EQ(payloads.size(), 379U);
  const beams::BeamTable table = beams::built_in_table(sensor::SensorModel::kVlp32c);
  decode::Decoder::Config config;
  config.columns = 1808;
  const Beside both =
      decode_beside<VelodyneReference>(payloads, table, elevations_of(table.lasers), config, 1808,
                                       [&](const Payload& payload, const Packet& packet) {
                                         return unwrap_by_time(payloads, payload, packet, 10.0);
                                       });
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.returns, 130'312U);
  // Its head goes out of view at 90 degrees five times, each time in the middle of a packet; three
  // times have to be seen until that is known.
  EXPECT_EQ(both.losses.rejected[static_cast<std::size_t>(frame::Reject::kAzimuthJump)], 3U);
  EXPECT_EQ(both.losses.rejected_total(), 3U);
  EXPECT_EQ(both.sectors_inside, 2U);
  EXPECT_EQ(both.decoded, 376U);
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
}

}  // namespace
}  // namespace terracut::reference
