// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// RoboSense's sensors with 32 lasers: what differs from the other sensors with a table. Streams
// beside a plain decoder: table/table_sensor_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "calib/beams/angle.hpp"
#include "firmware_io/ruby128/difop_angles.hpp"
#include "firmware_io/sensor/device_reader.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tests/support/reference/decode_beside.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::reference {
namespace {

using testing::HasSubstr;

template <class Sensor>
class RoboSenseStream : public testing::Test {};
template <class... Model>
using SensorsOf = testing::Types<RoboSense<Model>...>;
using Sensors = robosense::Models::In<SensorsOf>;
TYPED_TEST_SUITE(RoboSenseStream, Sensors);

TYPED_TEST(RoboSenseStream, RefusesWhatIsNoDataPacketOfTheModel) {
  robosense::PacketReader reader(robosense::layout_of(TypeParam::sheet().model));
  const auto good = TypeParam::payloads({.packets = 1})[0].bytes;
  packet::PacketAzimuths azimuths;
  const auto read = [&](std::size_t at, int value) {
    PayloadBytes bytes = good;
    bytes[at] = static_cast<std::uint8_t>(value);
    return reader.read(bytes, azimuths);
  };
  EXPECT_EQ(reader.read(good, azimuths), std::nullopt);
  EXPECT_EQ(read(31, 0), std::nullopt) << "a reader is of a model that somebody has named";
  EXPECT_EQ(read(0, 0), frame::Reject::kWrongMagic);
  EXPECT_EQ(read(42 + 11 * 100, 0xFE), frame::Reject::kWrongMagic);
  EXPECT_EQ(read(44 + 100, 0x8D), frame::Reject::kAzimuthOutOfRange);
  EXPECT_EQ(reader.read(std::span(good).first(good.size() - 1), azimuths),
            frame::Reject::kWrongSize);
  EXPECT_EQ(reader.read(TypeParam::device_payload(), azimuths), frame::Reject::kDeviceInfo);
  const auto of_another = Velodyne<velodyne::Vlp16>::payloads({.packets = 1})[0].bytes;
  EXPECT_EQ(reader.read(of_another, azimuths), frame::Reject::kWrongModel);
}

TYPED_TEST(RoboSenseStream, ReadsTheStampsOfEveryEncoding) {
  constexpr std::int64_t kNoon_ns = 1'767'268'800'123'456'000;  // 2026-01-01 12:00
  for (const auto encoding :
       {ruby128::RubyTimestamp::kCalendar, ruby128::RubyTimestamp::kUtcMicroseconds,
        ruby128::RubyTimestamp::kUtcNanoseconds}) {
    robosense::PacketReader reader(robosense::layout_of(TypeParam::sheet().model), encoding);
    auto payload = TypeParam::payloads({.packets = 1})[0].bytes;
    std::ranges::copy(ruby128::write_ruby_timestamp(kNoon_ns, encoding), payload.begin() + 20);
    packet::PacketAzimuths azimuths;
    ASSERT_EQ(reader.read(payload, azimuths), std::nullopt);
    EXPECT_EQ(azimuths.device_stamp_us, kNoon_ns / 1'000) << to_string(encoding);
  }
}

TYPED_TEST(RoboSenseStream, TakesItsTableFromDeviceInformation) {
  std::mt19937 random(5);
  const auto unit = TypeParam::random_unit(random);
  sensor::DeviceReader device;
  EXPECT_TRUE(device.add(robosense_device_payload(unit)));
  const auto& told = device.calibration(unit.model);
  ASSERT_TRUE(told) << told.error().message;
  const auto& table = std::get<beams::BeamTable>(*told);
  EXPECT_EQ(table.origin, "DIFOP packets");
  for (std::size_t i = 0; i < table.lasers.size(); ++i) {
    const double half_rad = beams::deg_to_rad(TypeParam::sheet().device_angle_deg / 2 + 1e-9);
    EXPECT_NEAR(table.lasers[i].elevation_rad, unit.lasers[i].elevation_rad, half_rad);
    EXPECT_NEAR(table.lasers[i].azimuth_offset_rad, unit.lasers[i].azimuth_offset_rad, half_rad);
  }
  // Written again it is the same.
  auto difop = ruby128::blank_difop();
  ruby128::set_table(difop, table);
  const auto again = ruby128::table_of(difop, unit.model);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->lasers, table.lasers);
}

TYPED_TEST(RoboSenseStream, SaysWhyDeviceInformationHoldsNoTable) {
  sensor::DeviceReader device;
  const sensor::SensorModel model = TypeParam::sheet().model;
  EXPECT_THAT(device.calibration(model).error().message, HasSubstr("no DIFOP packet has come"));
  auto payload = TypeParam::device_payload();
  const auto told = [&](std::size_t at, std::uint8_t sign) {
    auto bytes = payload;
    bytes[at] = sign;
    (void)device.add(bytes);
    return device.calibration(model).error().message;
  };
  EXPECT_THAT(told(468 + 3 * 31, 0xFF),
              HasSubstr("the elevation of channel 32 of 32 has the sign"));
  EXPECT_THAT(told(564, 7), HasSubstr("the azimuth offset of channel 1 of 32 has the sign 0x07"));
  EXPECT_TRUE(device.add(payload));
  EXPECT_TRUE(device.has_calibration(model));
}

TYPED_TEST(RoboSenseStream, WithoutATableSaysWhatToGive) {
  streams::FirstSeconds::Config config;
  config.place = "0.0.0.0:6699";
  streams::FirstSeconds first(config);
  for (const Payload& payload : TypeParam::payloads({.packets = 300})) {
    first.add({.payload = payload.bytes, .stamp_ns = payload.stamp_ns});
  }
  const auto found = first.conclude();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoCalibration);
  EXPECT_THAT(found.error().message, HasSubstr("angle.csv with --calibration"));
  EXPECT_THAT(found.error().message, testing::Not(HasSubstr("--nominal-calibration")));
}

TEST(RoboSense, AHeliosStatesCountsOfHalfAsManyMillimetres) {
  using Helios = RoboSense<robosense::Helios>;
  auto payloads = Helios::payloads({.packets = 400, .seed = 2});
  for (Payload& payload : payloads) payload.bytes[17] = 0;
  std::mt19937 random(7);
  const auto unit = Helios::random_unit(random);
  Helios::Reference reference(unit);
  for (Payload& payload : payloads) {
    erase_returns_on_the_seam<Helios>(payload.bytes, reference.decode(payload.bytes));
  }
  const Beside both = decode_beside<Helios>(payloads, unit, 1800);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.decoded, payloads.size());
}

}  // namespace
}  // namespace terracut::reference
