// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "rt/memory/fixed_memory.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/reference/agreement.hpp"
#include "tests/support/reference/sensors.hpp"

namespace terracut::reference {
namespace {

// --- Streams ---

struct Stream {
  RotatingHead head;
  double frames = 2.2;
  std::optional<int> columns = std::nullopt;  ///< Else as many as there are firings in a frame.
  double share_of_losses = 0;                 ///< Packets that do not arrive.
  double share_of_unmeasured = 0;             ///< Packets without any return.
};

template <class Sensor>
class BothDecoders {
 public:
  explicit BothDecoders(const Stream& stream)
      : random_(stream.head.seed),
        calibration_(Sensor::random_unit(random_)),
        mount_(random_mount(random_)) {
    const double firing_us = Sensor::firing_us(stream.head.dual_return);
    const double firings = 1e6 / firing_us / stream.head.spin_hz;
    config_.columns = stream.columns.value_or(static_cast<int>(std::lround(firings)));
    config_.returns_per_cell = 8;
    RotatingHead head = stream.head;
    head.first_deg = std::uniform_real_distribution<double>(0, 360)(random_);
    head.packets =
        static_cast<int>(stream.frames * firings / Sensor::firings_per_packet(head.dual_return));
    for (Payload& payload : Sensor::payloads(head)) {
      arrived_.push_back({std::move(payload), chance() >= stream.share_of_losses});
      if (chance() < stream.share_of_unmeasured) unmeasure(arrived_.back().payload);
    }
  }

  /// What of the product differs from the reference.
  std::string difference() {
    // Beams on the very seam may be of either frame.
    reference_pass([&](Payload& payload, const Packet& packet, double) {
      erase_returns_on_the_seam<Sensor>(payload.bytes, packet);
    });
    ExpectedFrames expected(Sensor::elevations(calibration_), mount_, config_.columns);
    reference_pass([&](Payload&, const Packet& packet, double unwrap_deg) {
      expected.add(packet, unwrap_deg);
      expected_returns_ += packet.returns.size();
    });

    memory::FixedMemory memory;
    typename Sensor::Decoder decoder(calibration_, mount_, config_, memory);
    HandedFrames handed;
    for (const Arrival& arrival : arrived_) {
      if (!arrival.arrives) continue;
      const auto reason = test::decode(
          decoder,
          packet::Datagram{.payload = arrival.payload.bytes, .stamp_ns = arrival.payload.stamp_ns},
          handed.keep());
      if (reason) return "refused: " + std::string(to_string(*reason));
    }
    dual_return_ = decoder.dual_return();
    test::end_stream(decoder, handed.keep());
    if (handed.returns() != expected_returns_) return "not every return is in a frame";
    return first_difference(expected, handed, config_.columns);
  }

  [[nodiscard]] const auto& calibration() const { return calibration_; }
  [[nodiscard]] std::size_t returns() const { return expected_returns_; }
  [[nodiscard]] bool dual_return() const { return dual_return_; }
  typename Sensor::Decoder::Config& config() { return config_; }

 private:
  struct Arrival {
    Payload payload;
    bool arrives = true;
  };

  double chance() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  static void unmeasure(Payload& payload) {
    for (int column = 0; column < Sensor::kColumns; ++column) {
      for (int laser = 0; laser < Sensor::kLasers; ++laser) {
        Sensor::set_return(payload.bytes, column, laser, 0, 0);
      }
    }
  }

  template <class Visitor>
  void reference_pass(Visitor&& visit) {
    typename Sensor::Reference reference = make_reference();
    Frames frames;
    for (Arrival& arrival : arrived_) {
      if (!arrival.arrives) {
        Sensor::reset(reference);
        continue;
      }
      const Packet packet = reference.decode(arrival.payload.bytes);
      ASSERT_EQ(packet.refusal, Refusal::kNone);
      visit(arrival.payload, packet, frames.unwrap(packet));
    }
  }

  auto make_reference() const {
    if constexpr (std::is_same_v<Sensor, Hdl64e>) {
      const bool ros_like = config_.hdl64e.geometry == hdl64e::GeometryModel::kRosLike;
      return Hdl64eReference(calibration_,
                             ros_like ? Hdl64eOffsets::kRosLike : Hdl64eOffsets::kManual);
    } else {
      return Ruby128Reference(calibration_);
    }
  }

  std::mt19937 random_;
  typename Sensor::Calibration calibration_;
  mount::Mount mount_;
  typename Sensor::Decoder::Config config_;
  std::vector<Arrival> arrived_;
  std::size_t expected_returns_ = 0;
  bool dual_return_ = false;
};

template <class Sensor>
void expect_agreement(const Stream& stream) {
  BothDecoders<Sensor> both(stream);
  ASSERT_TRUE(validate(both.calibration())) << validate(both.calibration()).error().message;
  EXPECT_EQ(both.difference(), "");
  EXPECT_GT(both.returns(), 1'000U);
  EXPECT_EQ(both.dual_return(), stream.head.dual_return);
}

// --- Tests ---

template <class Sensor>
class DecoderAndReference : public testing::Test {};

struct SensorNames {
  template <class Sensor>
  static std::string GetName(int) {
    return std::is_same_v<Sensor, Hdl64e> ? "Hdl64e" : "Ruby128";
  }
};
using Sensors = testing::Types<Hdl64e, Ruby128>;
TYPED_TEST_SUITE(DecoderAndReference, Sensors, SensorNames);

TYPED_TEST(DecoderAndReference, AgreeInSingleReturnAtEverySpin) {
  for (const double spin_hz : {5.0, 10.0, 20.0}) {
    SCOPED_TRACE(spin_hz);
    expect_agreement<TypeParam>({.head = {.spin_hz = spin_hz, .seed = 1}});
  }
}

TYPED_TEST(DecoderAndReference, AgreeInDualReturnAtEverySpin) {
  for (const double spin_hz : {5.0, 10.0, 20.0}) {
    SCOPED_TRACE(spin_hz);
    expect_agreement<TypeParam>({.head = {.spin_hz = spin_hz, .dual_return = true, .seed = 2}});
  }
}

TYPED_TEST(DecoderAndReference, AgreeForManyUnitsAndMountsAtOddSpins) {
  for (unsigned seed = 10; seed < 22; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const double spin_hz = std::uniform_real_distribution<double>(5, 20)(random);
    const bool dual_return = seed % 2 == 0;
    expect_agreement<TypeParam>({.head = {.spin_hz = spin_hz,
                                          .dual_return = dual_return,
                                          .share_of_returns = 0.2,
                                          .seed = seed},
                                 .frames = 1.4});
  }
}

TYPED_TEST(DecoderAndReference, AgreeWhenTheImageDoesNotFitTheSpin) {
  for (const int columns : {300, 1'024, 4'000, 9'000}) {
    SCOPED_TRACE(columns);
    expect_agreement<TypeParam>(
        {.head = {.share_of_returns = 0.3, .seed = 3}, .frames = 1.4, .columns = columns});
  }
}

TYPED_TEST(DecoderAndReference, AgreeBesideLostPackets) {
  for (const bool dual_return : {false, true}) {
    SCOPED_TRACE(dual_return);
    expect_agreement<TypeParam>(
        {.head = {.dual_return = dual_return, .seed = 4}, .frames = 2.5, .share_of_losses = 0.2});
  }
}

TYPED_TEST(DecoderAndReference, AgreeWhenMostPacketsHaveNothingMeasured) {
  expect_agreement<TypeParam>(
      {.head = {.share_of_returns = 0.05, .seed = 5}, .frames = 4.5, .share_of_unmeasured = 0.95});
}

TYPED_TEST(DecoderAndReference, RefuseTheSamePacketsForTheSameReason) {
  std::mt19937 random(6);
  const auto below = [&](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  const typename TypeParam::Calibration no_corrections;
  std::map<Refusal, int> seen;
  for (unsigned n = 0; n < 20'000; ++n) {
    std::vector<std::uint8_t> bytes(TypeParam::payloads({.packets = 1})[0].bytes);
    // A head that rotates or does not, evenly or not, singly or in pairs.
    const int step_cdeg = below(2) == 0 ? below(8) - 3 : below(140) - 20;
    const int jitter_cdeg = 1 + below(4), pairing = 1 + below(2), first = below(2);
    int azimuth_cdeg = below(36'000);
    for (int column = 0; column < TypeParam::kColumns; ++column) {
      if ((column + first) % pairing == 0) azimuth_cdeg += step_cdeg + below(jitter_cdeg);
      TypeParam::set_azimuth(bytes, column, static_cast<unsigned>(azimuth_cdeg + 36'000) % 36'000);
    }
    for (int bends = below(3); bends > 0; --bends) {
      const auto block_at = static_cast<std::size_t>(
          TypeParam::kFirstBlock + TypeParam::kBlockBytes * below(TypeParam::kBlocks));
      const auto at = below(4) == 0 ? static_cast<std::size_t>(below(40))
                                    : block_at + static_cast<std::size_t>(below(4));
      bytes[at] = static_cast<std::uint8_t>(below(3) == 0 ? below(256) : bytes[at] + below(9) - 4);
    }
    if (below(20) == 0) bytes.resize(static_cast<std::size_t>(below(1'300)));

    typename TypeParam::Reference reference(no_corrections);
    const Packet expected = reference.decode(bytes);
    packet::PacketAzimuths azimuths;
    const auto reason = TypeParam::check(bytes, azimuths);
    ASSERT_EQ(to_string(as_refusal(reason)), to_string(expected.refusal)) << n;
    if (!reason) {
      ASSERT_EQ(azimuths.dual_return, expected.dual_return) << n;
      ASSERT_NEAR(azimuths.step_ticks * 1e-5, expected.step_deg, 1e-9) << n;
    }
    ++seen[expected.refusal];
  }
  EXPECT_GT(seen[Refusal::kNone], 1'000);
  for (const Refusal refusal :
       {Refusal::kOtherPacket, Refusal::kAzimuthRange, Refusal::kUneven, Refusal::kNotRotating}) {
    EXPECT_GT(seen[refusal], 100) << to_string(refusal);
  }
  const bool pairs_of_blocks = TypeParam::kBlocks > TypeParam::kColumns;
  EXPECT_EQ(seen[Refusal::kUnequalFirings] > 100, pairs_of_blocks);
}

TEST(Hdl64eDecoderAndReference, AgreeInTheRosLikeGeometry) {
  BothDecoders<Hdl64e> both({.head = {.seed = 8}});
  both.config().hdl64e.geometry = hdl64e::GeometryModel::kRosLike;
  EXPECT_EQ(both.difference(), "");
}

}  // namespace
}  // namespace terracut::reference
