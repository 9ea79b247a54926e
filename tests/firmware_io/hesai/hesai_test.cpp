// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Hesai's sensors: streams made here beside a plain decoder written from the manuals, and real
// captures beside nebula's decode of a scan of each (data not part of the project; skipped where
// absent).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <unordered_map>

#include "calib/hesai/hesai_csv.hpp"
#include "firmware_io/hesai/stamp.hpp"
#include "tests/support/capture_payloads.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/places.hpp"
#include "tests/support/reference/decode_beside.hpp"
#include "tests/support/reference/sensors.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::reference {
namespace {

template <class Sensor>
class HesaiStream : public testing::Test {};
template <class... Model>
using SensorsOf =
    testing::Types<Hesai<Model>..., Hesai<hesai::Ot128, true>, Hesai<hesai::Pandar128, true>>;
using Sensors = hesai::Models::In<SensorsOf>;
TYPED_TEST_SUITE(HesaiStream, Sensors);

TYPED_TEST(HesaiStream, LosesNothingInASectorThatItIsBlindInAndCountsWhatIsLostBesideIt) {
  constexpr std::size_t kLearnt = 5, kLost = 3;
  std::mt19937 random(7);
  const auto unit = TypeParam::random_unit(random);
  hesai::PacketReader reader(hesai::layout_of(TypeParam::sheet().model));
  for (const bool dual_return : {false, true}) {
    SCOPED_TRACE(dual_return);
    const double turn = 1e5 / TypeParam::firing_us(dual_return) /
                        TypeParam::firings_per_packet(dual_return);  // in packets
    RotatingHead head{.dual_return = dual_return, .share_of_returns = 0.02};
    head.packets = static_cast<int>(10 * turn);
    auto payloads = TypeParam::payloads(head);
    const auto lost = payloads.begin() + static_cast<std::ptrdiff_t>(8.2 * turn);  // at 52 degrees
    payloads.erase(lost, lost + kLost);
    memory::FixedMemory memory;
    decode::Decoder decoder(unit, {}, {}, memory);
    std::vector<frame::FrameInfo> frames;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::MeasuredReturns&) noexcept { frames.push_back(info); };
    for (const Payload& payload : payloads) {
      packet::PacketAzimuths azimuths;
      ASSERT_EQ(reader.read(payload.bytes, azimuths), std::nullopt);
      if (azimuths.first_cdeg() >= 9'000 && azimuths.first_cdeg() < 27'000) continue;
      test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, on_frame);
    }
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(decoder.losses().network_gap_packets, kLost);
    EXPECT_EQ(decoder.losses().azimuth_hole_columns,
              kLost * static_cast<std::size_t>(TypeParam::kColumns) / (dual_return ? 2 : 1));
    EXPECT_NEAR(decoder.blind().from_cdeg, 9'000, 500);
    EXPECT_NEAR(decoder.blind().to_cdeg, 27'000, 500);
    ASSERT_GE(frames.size(), 10U);
    EXPECT_EQ(std::count_if(frames.begin() + kLearnt, frames.end() - 1,
                            [](const frame::FrameInfo& frame) { return !frame.complete; }),
              1);
  }
}

TYPED_TEST(HesaiStream, ReadsTheTimeThatItWasStampedWith) {
  const hesai::PacketLayout& layout = hesai::layout_of(TypeParam::sheet().model);
  auto payload = TypeParam::payloads({.packets = 1})[0].bytes;
  for (const std::int64_t stamp_us : {1'582'934'399'999'999, 1'709'164'805'000'001}) {
    hesai::write_stamp_us(layout, stamp_us, payload);
    EXPECT_EQ(hesai::read_stamp_us(layout, payload), stamp_us);
  }
}

TYPED_TEST(HesaiStream, RefusesWhatIsNoDataPacketOfTheModel) {
  const HesaiSheet& sheet = TypeParam::sheet();
  hesai::PacketReader reader(hesai::layout_of(sheet.model));
  const auto good = TypeParam::payloads({.packets = 1})[0].bytes;
  packet::PacketAzimuths azimuths;
  const auto read = [&](int at, int value) {
    PayloadBytes bytes = good;
    bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
    return reader.read(bytes, azimuths);
  };
  EXPECT_EQ(reader.read(good, azimuths), std::nullopt);
  for (const int single : {0x33, 0x34, 0x38}) EXPECT_EQ(read(sheet.mode_at, single), std::nullopt);
  EXPECT_EQ(read(sheet.mode_at, 0x3D), frame::Reject::kWrongMagic);  // three returns
  EXPECT_EQ(read(sheet.mode_at, 0x3B), frame::Reject::kAzimuthMismatch);
  EXPECT_EQ(read(sheet.azimuth_at(1) + 1, 0xA0), frame::Reject::kAzimuthOutOfRange);
  EXPECT_EQ(read(0, 0x00), frame::Reject::kWrongMagic);
  EXPECT_EQ(reader.read(std::span(good).first(good.size() - 1), azimuths),
            frame::Reject::kWrongSize);
  const auto of_another = Velodyne<velodyne::Vlp16>::payloads({.packets = 1})[0].bytes;
  EXPECT_EQ(reader.read(of_another, azimuths), frame::Reject::kWrongModel);
}

TYPED_TEST(HesaiStream, GoesOnAcrossTheEndsOfDaysMonthsAndYears) {
  const HesaiSheet& sheet = TypeParam::sheet();
  hesai::PacketReader reader(hesai::layout_of(sheet.model));
  constexpr std::int64_t kMidnight_ns = 1'767'225'600'000'000'000, kDay_ns = 86'400'000'000'000;
  using Date = std::array<std::uint8_t, 3>;
  const auto stamp_us = [&](const Date& date, std::int64_t since_midnight_ns) {
    auto payload = TypeParam::payloads({.packets = 1})[0].bytes;
    set_hesai_clock(sheet, payload, kMidnight_ns + since_midnight_ns);
    std::ranges::copy(date, payload.begin() + sheet.date_at);
    packet::PacketAzimuths azimuths;
    EXPECT_EQ(reader.read(payload, azimuths), std::nullopt);
    return azimuths.device_stamp_us;
  };
  for (const auto& [day, next] : {std::pair(Date{123, 1, 31}, Date{123, 2, 1}),
                                  {Date{123, 2, 28}, Date{123, 3, 1}},
                                  {Date{124, 2, 29}, Date{124, 3, 1}},
                                  {Date{125, 4, 30}, Date{125, 5, 1}},
                                  {Date{125, 12, 31}, Date{126, 1, 1}},
                                  {Date{24, 2, 29}, Date{24, 3, 1}}}) {
    EXPECT_EQ(stamp_us(next, 0) - stamp_us(day, kDay_ns - 1'000), 1)
        << int{day[0]} << "-" << int{day[1]};
  }
}

// --- Real captures ---

struct RealCapture {
  const char* file;
  const char* table;
  sensor::SensorModel model;
  std::uint64_t packets;
  std::size_t points;  ///< In nebula's cloud.
};

struct Point {
  float x_m = 0, y_m = 0, z_m = 0;
};

/// The cloud's points in the sensor frame here; nebula's has y at azimuth 0 and x at 90 degrees.
std::vector<Point> read_nebula(const std::filesystem::path& path) {
  const std::string bytes = test::content_of(path);
  const std::string kData = "DATA binary\n";
  std::vector<Point> points;
  for (std::size_t at = bytes.find(kData) + kData.size(); at + sizeof(Point) <= bytes.size();
       at += sizeof(Point)) {
    Point theirs;
    std::memcpy(&theirs, bytes.data() + at, sizeof(theirs));
    points.push_back({theirs.y_m, -theirs.x_m, theirs.z_m});
  }
  return points;
}

/// Points in boxes as wide as they may lie apart.
class Boxes {
 public:
  static constexpr float kApart_m = 0.002F;

  void add(const Point& point) { boxes_[key(box(point))].push_back(point); }
  [[nodiscard]] bool has_near(const Point& wanted) const {
    const Box of = box(wanted);
    for (int n = 0; n < 27; ++n) {
      const auto found =
          boxes_.find(key({of[0] + n % 3 - 1, of[1] + n / 3 % 3 - 1, of[2] + n / 9 - 1}));
      if (found == boxes_.end()) continue;
      for (const Point& point : found->second) {
        if (std::abs(point.x_m - wanted.x_m) < kApart_m &&
            std::abs(point.y_m - wanted.y_m) < kApart_m &&
            std::abs(point.z_m - wanted.z_m) < kApart_m) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  using Box = std::array<std::int64_t, 3>;
  static Box box(const Point& point) {
    const auto number = [](float m) { return static_cast<std::int64_t>(std::floor(m / kApart_m)); };
    return {number(point.x_m), number(point.y_m), number(point.z_m)};
  }
  static std::int64_t key(const Box& box) {
    return (box[0] * 1'000'003 + box[1]) * 1'000'003 + box[2];
  }
  std::unordered_map<std::int64_t, std::vector<Point>> boxes_;
};

class RealHesai : public testing::TestWithParam<RealCapture> {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = test::shared_data("hesai");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    auto table =
        hesai::read_hesai_csv(folder / (std::string(GetParam().table) + ".csv"), GetParam().model);
    ASSERT_TRUE(table) << table.error().message;
    table_ = *table;
    payloads_ = test::payloads_of(folder / (std::string(GetParam().file) + ".pcap"));
    ASSERT_EQ(payloads_.size(), GetParam().packets);
  }
  beams::BeamTable table_;
  std::vector<Payload> payloads_;
};

TEST_P(RealHesai, HasEveryPointThatNebulaFindsWithin2Mm) {
  const auto theirs =
      read_nebula(test::shared_data("hesai") / (std::string(GetParam().file) + ".nebula.pcd"));
  ASSERT_EQ(theirs.size(), GetParam().points);
  const mount::Mount mount{.height_m = 1};
  decode::Decoder::Config config;
  config.hesai.follows_firing = false;  // nebula takes the block's azimuth
  memory::FixedMemory memory;
  decode::Decoder decoder(table_, mount, config, memory);
  HandedFrames handed;
  for (const Payload& payload : payloads_) {
    test::decode(decoder, packet::Datagram{.payload = payload.bytes, .stamp_ns = payload.stamp_ns},
                 handed.keep());
  }
  test::end_stream(decoder, handed.keep());
  Boxes ours;
  for (const auto& returns : handed.frames()) {
    for (const PlacedReturn& one : returns) {
      ours.add({static_cast<float>(one.x_m), static_cast<float>(one.y_m),
                static_cast<float>(one.z_m - mount.height_m)});
    }
  }
  std::size_t missing = 0;
  for (const Point& point : theirs) missing += ours.has_near(point) ? 0U : 1U;
  EXPECT_EQ(missing, 0U);
}

TEST_P(RealHesai, EqualsAPlainSlowDecoderAndLosesNothing) {
  const Beside both =
      decode_beside<HesaiReference>(payloads_, table_, elevations_of(table_.lasers), 1800);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.decoded, GetParam().packets);
  EXPECT_TRUE(both.dual_return);
  EXPECT_EQ(both.losses.rejected_total(), 0U);
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
  EXPECT_EQ(both.losses.overflow_full_returns, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealHesai,
    testing::Values(
        RealCapture{"40p", "Pandar40P", sensor::SensorModel::kPandar40p, 1'439, 56'762},
        RealCapture{"64", "Pandar64", sensor::SensorModel::kPandar64, 2'400, 93'591},
        RealCapture{"qt64", "PandarQT64", sensor::SensorModel::kPandarQt64, 1'200, 34'158},
        RealCapture{"qt128", "PandarQT128", sensor::SensorModel::kPandarQt128, 1'800, 73'560},
        RealCapture{"xt32", "PandarXT32", sensor::SensorModel::kPandarXt32, 2'000, 63'021}),
    [](const auto& capture) { return "Of" + std::string(capture.param.file); });

}  // namespace
}  // namespace terracut::reference
