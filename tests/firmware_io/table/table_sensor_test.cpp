// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What holds for every sensor with a built-in table: streams made here beside a plain decoder
// written from the manuals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_io/streams/first_seconds.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/reference/decode_beside.hpp"
#include "tests/support/reference/sensors.hpp"
#include "tests/support/thinned.hpp"

namespace terracut::reference {
namespace {

template <class... Hesai_>
struct WithHesai {
  template <class... RoboSense_>
  struct AndRoboSense {
    template <class... Velodyne_>
    using AndVelodyne =
        testing::Types<Velodyne<Velodyne_>..., RoboSense<RoboSense_>..., Hesai<Hesai_>...,
                       Hesai<hesai::Ot128, true>, Hesai<hesai::Pandar128, true>>;
  };
  using WithRoboSense = robosense::Models::In<AndRoboSense>;
};
template <class Sensor>
class TableSensorStream : public testing::Test {};
using Sensors = velodyne::Models::In<hesai::Models::In<WithHesai>::WithRoboSense::AndVelodyne>;
TYPED_TEST_SUITE(TableSensorStream, Sensors);

TYPED_TEST(TableSensorStream, AgreesWithAPlainSlowDecoderAtEverySpinAndInEitherReturnMode) {
  for (const bool dual_return : {false, true}) {
    for (const double spin_hz : test::thinned({5.0, 9.3, 10.0, 20.0})) {
      SCOPED_TRACE(testing::Message() << spin_hz << " Hz, dual " << dual_return);
      std::mt19937 random(7);
      const auto unit = TypeParam::random_unit(random);
      const double firings = 1e6 / TypeParam::firing_us(dual_return) / spin_hz;
      RotatingHead head{.spin_hz = spin_hz, .dual_return = dual_return, .seed = 3};
      head.packets = static_cast<int>(3.2 * firings / TypeParam::firings_per_packet(dual_return));
      auto payloads = TypeParam::payloads(head);
      typename TypeParam::Reference reference(unit);
      for (Payload& payload : payloads) {
        erase_returns_on_the_seam<TypeParam>(payload.bytes, reference.decode(payload.bytes));
      }
      const Beside both =
          decode_beside<TypeParam>(payloads, unit, static_cast<int>(std::lround(firings)));
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

TYPED_TEST(TableSensorStream, CountsLostPacketsByTheDevicesStamps) {
  std::mt19937 random(7);
  const auto payloads = TypeParam::payloads({.packets = 400});
  for (const std::size_t lost : {1U, 3U, 50U}) {
    std::vector<Payload> arrived = payloads;
    arrived.erase(arrived.begin() + 200, arrived.begin() + 200 + static_cast<std::ptrdiff_t>(lost));
    const Beside both = decode_beside<TypeParam>(arrived, TypeParam::random_unit(random), 1800);
    EXPECT_EQ(both.losses.network_gap_packets, lost);
    EXPECT_EQ(both.losses.azimuth_hole_columns,
              lost * static_cast<std::size_t>(TypeParam::kImageColumns));
  }
}

TYPED_TEST(TableSensorStream, ColumnsAreCompleteAsTheHeadPassesThem) {
  std::mt19937 random(7);
  const auto unit = TypeParam::random_unit(random);
  for (const bool dual_return : {false, true}) {
    const double firings = 1e5 / TypeParam::firing_us(dual_return);
    RotatingHead head{.dual_return = dual_return};
    head.packets = static_cast<int>(2.5 * firings / TypeParam::firings_per_packet(dual_return));
    memory::FixedMemory memory;
    decode::Decoder::Config config;
    config.columns = static_cast<int>(std::lround(firings));
    decode::Decoder decoder(unit, {}, config, memory);
    int frames = 0, complete = 0, most_at_once = 0;
    const auto on_frame = [&](const frame::FrameInfo&, const frame::MeasuredReturns&) noexcept {
      ++frames;
    };
    for (const Payload& payload : TypeParam::payloads(head)) {
      test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, on_frame);
      const int now = decoder.arriving().complete_columns;
      // The first frame begins wherever the stream does.
      if (frames > 0) most_at_once = std::max(most_at_once, now - complete);
      complete = now;
    }
    EXPECT_GE(frames, 2);
    EXPECT_GT(complete, 0);
    // Of the models whose packets have most firings, two packets' and one.
    EXPECT_LE(most_at_once,
              std::max(48, static_cast<int>(2 * TypeParam::firings_per_packet(false) + 1)));
  }
}

TYPED_TEST(TableSensorStream, HasNoHolesWherePacketsCameLateAndSwapped) {
  std::mt19937 random(7);
  auto payloads = TypeParam::payloads({.packets = 400});
  std::swap(payloads[200], payloads[202]);
  const Beside both = decode_beside<TypeParam>(payloads, TypeParam::random_unit(random), 1800);
  EXPECT_EQ(both.decoded, payloads.size());
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
}

TYPED_TEST(TableSensorStream, IsDecodedWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  for (const bool dual_return : {false, true}) {
    auto payloads = TypeParam::payloads({.dual_return = dual_return, .packets = 500});
    payloads.erase(payloads.begin() + 200, payloads.begin() + 210);
    std::swap(payloads[300], payloads[301]);
    TypeParam::set_azimuth(payloads[400].bytes, 0, 36'000);
    memory::FixedMemory memory;
    decode::Decoder decoder(beams::built_in_table(TypeParam::sheet().model), {}, {}, memory);
    std::uint64_t returns = 0, decoded = 0;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::MeasuredReturns&) noexcept { returns += info.returns; };
    const std::size_t planned = memory.total_bytes();
    const std::uint64_t before = test::allocations_of_this_thread();
    for (int loop = 0; loop < 3; ++loop) {
      for (const Payload& payload : payloads) {
        test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, on_frame);
      }
      if (loop == 0) decoded = decoder.packets_decoded();
    }
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
    EXPECT_EQ(memory.total_bytes(), planned);
    EXPECT_EQ(decoded, 489U);
    // A Hesai's packets of some models have few lasers.
    EXPECT_GT(returns, sensor::is_hesai(TypeParam::sheet().model) ? 50'000U : 80'000U);
  }
}

TYPED_TEST(TableSensorStream, IsFoundByItselfWithItsTable) {
  for (const bool dual_return : {false, true}) {
    streams::FirstSeconds::Config config;
    config.place = "0.0.0.0:2368";
    streams::FirstSeconds first(config);
    RotatingHead head{.dual_return = dual_return, .share_of_returns = 0.1};
    head.packets = static_cast<int>(0.5e6 / TypeParam::firing_us(dual_return) /
                                    TypeParam::firings_per_packet(dual_return));
    const auto payloads = TypeParam::payloads(head);
    for (const Payload& payload : payloads) {
      first.add({.payload = payload.bytes, .stamp_ns = payload.stamp_ns});
    }
    if constexpr (requires { TypeParam::device_payload(); }) {
      EXPECT_FALSE(first.is_enough());
      first.add({.payload = TypeParam::device_payload(), .stamp_ns = payloads.back().stamp_ns});
    }
    ASSERT_TRUE(first.is_enough()) << first.waits_for();
    const auto found = first.conclude();
    ASSERT_TRUE(found) << found.error().message;
    const sensor::SensorModel model = TypeParam::sheet().model;
    EXPECT_EQ(found->model, model);
    EXPECT_NEAR(found->spin_hz, 10, sensor::is_hesai(model) ? 0.03 : 0.02);
    EXPECT_EQ(found->dual_return, dual_return);
    EXPECT_NEAR(found->columns, 1e5 / TypeParam::firing_us(dual_return), 1);
    EXPECT_EQ(calib::fingerprint(found->calibration), fingerprint(beams::built_in_table(model)));
    EXPECT_EQ(calib::origin_of(found->calibration).starts_with("nominal table of the "),
              sensor::is_hesai(model));
  }
}

}  // namespace
}  // namespace terracut::reference
