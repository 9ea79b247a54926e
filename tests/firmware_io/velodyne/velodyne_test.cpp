// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Velodyne's models with a built-in table: streams made here and real captures (data not part of
// the project; skipped where absent) beside a plain decoder written from the manuals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <random>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/places.hpp"
#include "tests/support/reference/agreement.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::reference {
namespace {

/// What both decoders make of a stream.
struct Both {
  std::string difference;
  frame::LossCounters losses;
  std::vector<frame::FrameInfo> frames;
  std::size_t returns = 0;
  std::uint64_t decoded = 0;
  bool dual_return = false;
  std::size_t sectors_inside = 0;  ///< Packets decoded on both sides of a blind sector.
};

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

/// Packets that the reference refuses must be refused, unless a known blind sector lies in them.
Both decode_both(const std::vector<Payload>& payloads, const beams::BeamTable& table, int columns,
                 std::optional<double> spin_hz = std::nullopt) {
  const mount::Mount mount{.height_m = 1.9, .roll_rad = -0.02, .pitch_rad = 0.04};
  std::vector<double> elevations;
  for (const auto& laser : table.lasers) elevations.push_back(laser.elevation_rad);
  VelodyneReference reference(table);
  ExpectedFrames expected(elevations, mount, columns);
  Frames frames;
  memory::FixedMemory memory;
  decode::Decoder::Config config;
  config.columns = columns;
  decode::Decoder decoder(table, mount, config, memory);
  HandedFrames handed;
  Both both;
  const auto keep = handed.keep();
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    both.frames.push_back(info);
    keep(info, image);
  };
  for (const Payload& payload : payloads) {
    Packet plain = reference.decode(payload.bytes);
    const auto reason = test::decode(
        decoder, packet::Datagram{.payload = payload.bytes, .stamp_ns = payload.stamp_ns},
        on_frame);
    const bool goes_on_behind_sector = !reason && plain.refusal == Refusal::kUneven;
    if (goes_on_behind_sector) plain = reference.decode(payload.bytes, true);
    both.sectors_inside += goes_on_behind_sector ? 1U : 0U;
    EXPECT_EQ(reason.has_value(), plain.refusal != Refusal::kNone);
    if (plain.refusal != Refusal::kNone) continue;
    expected.add(
        plain, spin_hz ? unwrap_by_time(payloads, payload, plain, *spin_hz) : frames.unwrap(plain));
  }
  both.dual_return = decoder.dual_return();
  test::end_stream(decoder, on_frame);
  both.difference = first_difference(expected, handed, columns);
  both.losses = decoder.losses();
  both.returns = handed.returns();
  both.decoded = decoder.packets_decoded();
  return both;
}

template <class Sensor>
class VelodyneStream : public testing::Test {};
template <class... Model>
using SensorsOf = testing::Types<Velodyne<Model>...>;
using Sensors = velodyne::Models::In<SensorsOf>;
TYPED_TEST_SUITE(VelodyneStream, Sensors);

TYPED_TEST(VelodyneStream, AgreesWithAPlainSlowDecoderAtEverySpinAndInEitherReturnMode) {
  for (const bool dual_return : {false, true}) {
    for (const double spin_hz : {5.0, 9.3, 10.0, 20.0}) {
      SCOPED_TRACE(testing::Message() << spin_hz << " Hz, dual " << dual_return);
      std::mt19937 random(7);
      const auto unit = TypeParam::random_unit(random);
      const double firings = 1e6 / TypeParam::firing_us(dual_return) / spin_hz;
      RotatingHead head{.spin_hz = spin_hz, .dual_return = dual_return, .seed = 3};
      head.packets = static_cast<int>(3.2 * firings / TypeParam::firings_per_packet(dual_return));
      auto payloads = TypeParam::payloads(head);
      VelodyneReference reference(unit);
      for (Payload& payload : payloads) {
        erase_returns_on_the_seam<TypeParam>(payload.bytes, reference.decode(payload.bytes));
      }
      const Both both = decode_both(payloads, unit, static_cast<int>(std::lround(firings)));
      EXPECT_EQ(both.difference, "");
      EXPECT_EQ(both.decoded, payloads.size());
      EXPECT_EQ(both.dual_return, dual_return);
      EXPECT_EQ(both.losses.network_gap_packets, 0U);
      EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
      EXPECT_EQ(both.losses.overflow_full_returns, 0U);
      EXPECT_EQ(both.losses.clock_jumps, 0U);
      ASSERT_GE(both.frames.size(), 4U);
      for (std::size_t n = 1; n + 1 < both.frames.size(); ++n) {
        EXPECT_TRUE(both.frames[n].complete) << n;
      }
    }
  }
}

TYPED_TEST(VelodyneStream, CountsLostPacketsByTheDevicesStamps) {
  std::mt19937 random(7);
  const auto payloads = TypeParam::payloads({.packets = 400});
  for (const std::size_t lost : {1U, 3U, 50U}) {
    std::vector<Payload> arrived = payloads;
    arrived.erase(arrived.begin() + 200, arrived.begin() + 200 + static_cast<std::ptrdiff_t>(lost));
    const Both both = decode_both(arrived, TypeParam::random_unit(random), 1808);
    EXPECT_EQ(both.losses.network_gap_packets, lost);
    EXPECT_EQ(both.losses.azimuth_hole_columns,
              lost * static_cast<std::size_t>(TypeParam::kColumns) /
                  static_cast<std::size_t>(TypeParam::sheet().firings_a_block));
  }
}

TYPED_TEST(VelodyneStream, HasNoHolesWherePacketsCameLateAndSwapped) {
  std::mt19937 random(7);
  auto payloads = TypeParam::payloads({.packets = 400});
  std::swap(payloads[200], payloads[202]);
  const Both both = decode_both(payloads, TypeParam::random_unit(random), 1808);
  EXPECT_EQ(both.decoded, payloads.size());
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
}

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

TYPED_TEST(VelodyneStream, IsDecodedWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  for (const bool dual_return : {false, true}) {
    auto payloads = TypeParam::payloads({.dual_return = dual_return, .packets = 500});
    payloads.erase(payloads.begin() + 200, payloads.begin() + 210);
    std::swap(payloads[300], payloads[301]);
    TypeParam::set_azimuth(payloads[400].bytes, 0, 36'000);
    memory::FixedMemory memory;
    decode::Decoder decoder(beams::built_in_table(TypeParam::sheet().model), {}, {}, memory);
    std::uint64_t returns = 0;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::MeasuredReturns&) noexcept { returns += info.returns; };
    const std::size_t planned = memory.total_bytes();
    const std::uint64_t before = test::allocations_of_this_thread();
    for (int loop = 0; loop < 3; ++loop) {
      for (const Payload& payload : payloads) {
        test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, on_frame);
      }
    }
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
    EXPECT_EQ(memory.total_bytes(), planned);
    EXPECT_GT(returns, 80'000U);
  }
}

TYPED_TEST(VelodyneStream, IsFoundByItselfWithItsTable) {
  for (const bool dual_return : {false, true}) {
    streams::FirstSeconds::Config config;
    config.place = "0.0.0.0:2368";
    streams::FirstSeconds first(config);
    RotatingHead head{.dual_return = dual_return, .share_of_returns = 0.1};
    head.packets = static_cast<int>(0.5e6 / TypeParam::firing_us(dual_return) /
                                    TypeParam::firings_per_packet(dual_return));
    for (const Payload& payload : TypeParam::payloads(head)) {
      first.add({.payload = payload.bytes, .stamp_ns = payload.stamp_ns});
    }
    ASSERT_TRUE(first.is_enough()) << first.waits_for();
    const auto found = first.conclude();
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->model, TypeParam::layout().model);
    EXPECT_NEAR(found->spin_hz, 10, 0.02);
    EXPECT_EQ(found->dual_return, dual_return);
    EXPECT_NEAR(found->columns, 1e5 / TypeParam::firing_us(dual_return), 1);
    EXPECT_EQ(calib::fingerprint(found->calibration),
              fingerprint(beams::built_in_table(TypeParam::sheet().model)));
  }
}

// --- Real captures ---

struct RealCapture {
  const char* file;
  sensor::SensorModel model;
  std::uint64_t packets, returns;
  bool dual_return;
  std::size_t frames;  ///< By hand: seams that the head passes, and one.
};

std::vector<Payload> read_payloads(const std::filesystem::path& path) {
  std::vector<Payload> payloads;
  auto source = capture::CaptureSource::open(path, {.port = 2368});
  if (!source) return payloads;
  for (auto next = source->next(); next && *next; next = source->next()) {
    payloads.push_back({{(*next)->payload.begin(), (*next)->payload.end()}, (*next)->stamp_ns});
  }
  return payloads;
}

class RealVelodyne : public testing::TestWithParam<RealCapture> {};

TEST_P(RealVelodyne, EqualsAPlainSlowDecoderAndLosesNothing) {
  const auto path = test::shared_data("pcap") / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto payloads = read_payloads(path);
  ASSERT_EQ(payloads.size(), GetParam().packets);
  const Both both = decode_both(payloads, beams::built_in_table(GetParam().model), 1808);
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
  const auto payloads = read_payloads(path);
  ASSERT_EQ(payloads.size(), 379U);
  const Both both =
      decode_both(payloads, beams::built_in_table(sensor::SensorModel::kVlp32c), 1808, 10.0);
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
