// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Ouster's sensors: streams made here beside a plain decoder written from the documentation, and
// real captures beside the maker's digests of every decoded field (data not part of the project;
// skipped where absent).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "calib/ouster/ouster_metadata.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/ouster/head_reader.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/capture_payloads.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/md5.hpp"
#include "tests/support/places.hpp"
#include "tests/support/reference/decode_beside.hpp"
#include "tests/support/reference/ouster_reference.hpp"
#include "tests/support/thinned.hpp"

namespace terracut::reference {
namespace {

using ouster::OusterCalibration;
using ouster::Profile;

Beside decode_both(const std::vector<Payload>& payloads, const OusterCalibration& unit) {
  Frames frames;
  return decode_beside<OusterReference>(
      payloads, unit, elevations_of(unit.lasers), {}, unit.columns_per_frame,
      [&](const Payload&, const Packet& packet) { return frames.unwrap(packet); });
}

struct Made {
  int rows;
  Profile profile;
};

class OusterStream : public testing::TestWithParam<Made> {
 protected:
  [[nodiscard]] static OusterCalibration unit(unsigned seed = 7) {
    std::mt19937 random(seed);
    return random_ouster(GetParam().rows, GetParam().profile, random);
  }
  /// A unit in the usual mode.
  [[nodiscard]] static OusterCalibration usual() {
    OusterCalibration made = unit();
    made.columns_per_frame = 1024;
    made.rate_hz = 10;
    made.window = {0, 1023};
    return made;
  }
};

TEST_P(OusterStream, AgreesWithAPlainSlowDecoderInEveryMode) {
  for (const auto& [columns, rate_hz] : test::thinned({std::pair(512, 10.0),
                                                       {512, 20.0},
                                                       {1024, 10.0},
                                                       {1024, 20.0},
                                                       {2048, 10.0},
                                                       {4096, 5.0}})) {
    SCOPED_TRACE(testing::Message() << columns << " columns at " << rate_hz << " Hz");
    OusterCalibration made = unit();
    made.columns_per_frame = columns;
    made.rate_hz = rate_hz;
    made.window = {0, columns - 1};
    const int packets = static_cast<int>(3.2 * columns / 16);
    const auto payloads =
        ouster_payloads(made, {.packets = packets, .share_of_returns = 0.5, .seed = 3});
    const Beside both = decode_both(payloads, made);
    EXPECT_EQ(both.difference, "");
    EXPECT_EQ(both.decoded, payloads.size());
    EXPECT_EQ(both.dual_return, ouster_sheet_of(GetParam().profile).is_dual);
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

TEST_P(OusterStream, CountsLostPacketsByTheUnitsStamps) {
  const OusterCalibration made = usual();
  const auto payloads = ouster_payloads(made, {.packets = 200, .share_of_returns = 0.1});
  for (const std::size_t lost : {1U, 3U, 40U}) {
    std::vector<Payload> arrived = payloads;
    arrived.erase(arrived.begin() + 100, arrived.begin() + 100 + static_cast<std::ptrdiff_t>(lost));
    const Beside both = decode_both(arrived, made);
    EXPECT_EQ(both.losses.network_gap_packets, lost);
    EXPECT_EQ(both.losses.azimuth_hole_columns, lost * 16);
  }
}

TEST_P(OusterStream, HasNoHolesWherePacketsCameLateAndSwapped) {
  const OusterCalibration made = usual();
  auto payloads = ouster_payloads(made, {.packets = 200, .share_of_returns = 0.1});
  std::swap(payloads[100], payloads[102]);
  const Beside both = decode_both(payloads, made);
  EXPECT_EQ(both.decoded, payloads.size());
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.azimuth_hole_columns, 0U);
}

/// What a decoder makes of eight frames that are sent from column 256 to 767, of which the seventh
/// lacks two packets.
void expect_window(const OusterCalibration& unit, const OusterCalibration& told,
                   bool is_known_at_once) {
  std::vector<Payload> sent;
  const auto all =
      ouster_payloads(unit, {.first_deg = 0, .packets = 8 * 64, .share_of_returns = 0.2});
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (n % 64 >= 16 && n % 64 < 48) sent.push_back(all[n]);
  }
  sent.erase(sent.begin() + 6 * 32 + 10, sent.begin() + 6 * 32 + 12);
  memory::FixedMemory memory;
  decode::Decoder decoder(told, {}, {}, memory);
  std::vector<frame::FrameInfo> frames;
  const auto keep = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    frames.push_back(info);
  };
  for (const Payload& payload : sent) {
    test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, keep);
  }
  test::end_stream(decoder, keep);
  EXPECT_EQ(decoder.packets_decoded(), sent.size());
  EXPECT_NEAR(decoder.blind().width_cdeg(), 18'000, 100);
  EXPECT_EQ(decoder.losses().rejected_total(), 0U);
  EXPECT_EQ(decoder.losses().network_gap_packets, 2U);
  EXPECT_EQ(decoder.losses().azimuth_hole_columns, 32U);
  ASSERT_EQ(frames.size(), 8U);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    EXPECT_EQ(frames[n].complete, n != 6 && (is_known_at_once || n >= 3)) << n;
  }
}

TEST_P(OusterStream, KnowsTheAzimuthWindowOfItsMetadataFromTheBeginning) {
  OusterCalibration told = usual();
  told.window = {260, 760};  // packets are sent whole
  expect_window(usual(), told, true);
}

TEST_P(OusterStream, LearnsAnAzimuthWindowThatIsNotStated) {
  expect_window(usual(), usual(), false);
}

TEST_P(OusterStream, BelievesPacketsThatContradictItsMetadatasWindow) {
  OusterCalibration told = usual();
  told.window = {256, 767};
  const auto payloads =
      ouster_payloads(usual(), {.first_deg = 0, .packets = 6 * 64, .share_of_returns = 0.2});
  const Beside both = decode_both(payloads, told);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.decoded, payloads.size());
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
}

TEST_P(OusterStream, LeavesInvalidColumnsOutAndDecodesTheRest) {
  const OusterCalibration made = usual();
  auto payloads = ouster_payloads(made, {.packets = 130, .share_of_returns = 0.3});
  const auto make_invalid_but = [&](int packet, std::uint32_t valid) {
    Payload& payload = payloads[static_cast<std::size_t>(packet)];
    const auto stamp_ns = static_cast<std::uint64_t>(payload.stamp_ns) - 1'562'500U;
    set_ouster_columns(made, payload.bytes, (60 + packet) % 64 * 16, stamp_ns, valid);
  };
  make_invalid_but(80, 0xFFF0);
  make_invalid_but(90, 0);
  const OusterSheet& sheet = ouster_sheet_of(made.format.profile);
  // An invalid column may be empty but for its place.
  const auto at = payloads[80].bytes.begin() + sheet.column_at(made.format.rows, 1);
  std::fill(at, at + sheet.column_bytes(made.format.rows), std::uint8_t{0});
  const Beside both = decode_both(payloads, made);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.decoded, payloads.size());
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
}

TEST_P(OusterStream, RefusesWhatIsNoDataPacketOfTheUnit) {
  const OusterCalibration made = usual();
  const ouster::Mode mode{made.format, made.columns_per_frame, made.rate_hz};
  const auto good = ouster_payloads(made, {.packets = 1})[0].bytes;
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(ouster::read_packet(mode, good, azimuths), std::nullopt);
  EXPECT_EQ(ouster::read_packet(mode, std::span(good).first(good.size() - 1), azimuths),
            frame::Reject::kWrongSize);
  EXPECT_EQ(ouster::read_packet(mode, std::vector<std::uint8_t>(48), azimuths),
            frame::Reject::kDeviceInfo);
  auto bent = good;
  bent[static_cast<std::size_t>(
      ouster_sheet_of(made.format.profile).column_at(made.format.rows, 3) + 8)] ^= 1;
  EXPECT_EQ(ouster::read_packet(mode, bent, azimuths), frame::Reject::kWrongMagic);
  bent = good;
  set_ouster_columns(made, bent, 1024, 0);
  EXPECT_EQ(ouster::read_packet(mode, bent, azimuths), frame::Reject::kAzimuthOutOfRange);
}

TEST_P(OusterStream, IsToldFromOtherFormatsOfItsSizeByItsRowsOrItsReturns) {
  const OusterCalibration made = usual();
  const sensor::SensorModel model = ouster::model_of_rows(made.format.rows);
  for (const double share : {0.0, 0.05, 1.0}) {
    for (const Payload& payload :
         ouster_payloads(made, {.packets = 70, .share_of_returns = share})) {
      EXPECT_EQ(ouster::format_of(payload.bytes, made.format.rows), made.format);
      EXPECT_EQ(sensor::recognise_sensor_as(model, payload.bytes), model);
      if (share == 0) continue;
      EXPECT_EQ(ouster::format_of(payload.bytes), made.format);
      EXPECT_EQ(sensor::recognise_sensor(payload.bytes), model);
    }
  }
}

TEST_P(OusterStream, ShowsItsColumnsAndRateWithoutMetadata) {
  for (const auto& [columns, rate_hz] :
       {std::pair(512, 20.0), {1024, 10.0}, {1024, 20.0}, {2048, 10.0}}) {
    OusterCalibration made = usual();
    made.columns_per_frame = columns;
    made.rate_hz = rate_hz;
    ouster::HeadReader reader;
    packet::PacketAzimuths azimuths;
    for (const Payload& payload :
         ouster_payloads(made, {.packets = columns / 8, .share_of_returns = 0.1})) {
      EXPECT_EQ(reader.read(payload.bytes, made.format.rows, azimuths), std::nullopt);
    }
    EXPECT_EQ(packet::kRevolution_ticks / azimuths.step_ticks, columns);
    EXPECT_NEAR(static_cast<double>(azimuths.nominal_period_ns), 16e9 / (columns * rate_hz), 16);
  }
}

TEST_P(OusterStream, IsDecodedWithoutAllocating) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  const OusterCalibration made = usual();
  auto payloads = ouster_payloads(made, {.packets = 300, .share_of_returns = 0.5});
  payloads.erase(payloads.begin() + 100, payloads.begin() + 110);
  std::swap(payloads[200], payloads[201]);
  payloads[250].bytes.pop_back();
  memory::FixedMemory memory;
  decode::Decoder decoder(made, {}, {}, memory);
  const auto on_frame = [](const frame::FrameInfo&, const frame::MeasuredReturns&) noexcept {};
  const std::size_t planned = memory.total_bytes();
  const std::uint64_t before = test::allocations_of_this_thread();
  for (const Payload& payload : payloads) {
    test::decode(decoder, {.payload = payload.bytes, .stamp_ns = payload.stamp_ns}, on_frame);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory.total_bytes(), planned);
  EXPECT_EQ(decoder.packets_decoded(), 289U);
}

TEST_P(OusterStream, IsFoundOnAirAndAsksForItsMetadata) {
  const OusterCalibration made = usual();
  streams::FirstSeconds::Config config;
  config.place = "0.0.0.0:7502";
  streams::FirstSeconds without(config);
  config.calibration.unit = made;
  streams::FirstSeconds with(config);
  for (const Payload& payload : ouster_payloads(made, {.packets = 320, .share_of_returns = 0.1})) {
    without.add({.payload = payload.bytes, .stamp_ns = payload.stamp_ns});
    with.add({.payload = payload.bytes, .stamp_ns = payload.stamp_ns});
  }
  ASSERT_TRUE(without.is_enough()) << without.waits_for();
  const auto refused = without.conclude();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNoCalibration);
  EXPECT_NE(refused.error().message.find(".json"), std::string::npos) << refused.error().message;
  ASSERT_TRUE(with.is_enough()) << with.waits_for();
  const auto found = with.conclude();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->model, ouster::model_of_rows(made.format.rows));
  EXPECT_EQ(found->columns, 1024);
  EXPECT_EQ(found->spin_hz, 10);
}

std::string name_of(const testing::TestParamInfo<Made>& made) {
  std::string name = std::to_string(made.param.rows);
  for (const char c : ouster::row_of(made.param.profile).name) {
    if (c != '_') name += c;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Formats, OusterStream,
                         testing::Values(Made{32, Profile::kLegacy}, Made{64, Profile::kLegacy},
                                         Made{128, Profile::kLegacy}, Made{32, Profile::kSingle},
                                         Made{64, Profile::kSingle}, Made{128, Profile::kSingle},
                                         Made{32, Profile::kDual}, Made{64, Profile::kDual},
                                         Made{128, Profile::kDual}, Made{32, Profile::kLowRate},
                                         Made{64, Profile::kLowRate}, Made{128, Profile::kLowRate},
                                         Made{32, Profile::kLowRateDual},
                                         Made{64, Profile::kLowRateDual},
                                         Made{128, Profile::kLowRateDual}),
                         name_of);

// --- Real captures ---

struct RealCapture {
  const char* name;
  const char* file;
  const char* metadata;
  std::uint64_t packets, returns;  ///< As counted by hand in the bytes.
  bool has_digest = false;
};

class RealOuster : public testing::TestWithParam<RealCapture> {
 protected:
  void SetUp() override {
    folder_ = test::shared_data("ouster");
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is not here";
    auto unit =
        ouster::read_ouster_metadata(folder_ / (std::string(GetParam().metadata) + ".json"));
    ASSERT_TRUE(unit) << unit.error().message;
    unit_ = *unit;
    payloads_ = test::payloads_of(folder_ / (std::string(GetParam().file) + ".pcap"), 7502);
    ASSERT_EQ(payloads_.size(), GetParam().packets);
  }
  std::filesystem::path folder_;
  OusterCalibration unit_;
  std::vector<Payload> payloads_;
};

TEST_P(RealOuster, EqualsTheMakersFormulaWithin1MmAndLosesNothing) {
  const Beside both = decode_both(payloads_, unit_);
  EXPECT_EQ(both.difference, "");
  EXPECT_EQ(both.decoded, GetParam().packets);
  EXPECT_EQ(both.returns, GetParam().returns);
  EXPECT_EQ(both.losses.rejected_total(), 0U);
  EXPECT_EQ(both.losses.network_gap_packets, 0U);
  EXPECT_EQ(both.losses.overflow_full_returns, 0U);
}

TEST_P(RealOuster, HasTheMakersDigestOfEveryField) {
  if (!GetParam().has_digest) GTEST_SKIP() << "the maker gives no digest of it";
  std::ifstream file(folder_ / (std::string(GetParam().file) + "_digest.json"));
  const nlohmann::json all_digests = nlohmann::json::parse(file);
  const nlohmann::json digest = all_digests.at("packet_hash");
  const OusterReference reference(unit_);
  std::map<std::string, std::string> plain, ours;
  const int rows = unit_.format.rows, columns = unit_.format.columns;
  for (const Payload& payload : payloads_) {
    for (const auto& [name, bytes] : reference.fields(payload.bytes)) plain[name] += bytes;
    const auto n = static_cast<std::size_t>(rows);
    std::vector<std::vector<std::uint32_t>> range_mm;
    std::vector<std::vector<std::uint8_t>> reflectivity;
    for (int column = 0; column < columns; ++column) {
      std::vector<std::uint16_t> raw(n);
      std::vector<std::uint8_t> fine(n), intensity(n);
      ouster::read_returns(unit_.format, payload.bytes.data(), static_cast<std::size_t>(column),
                           raw, fine, intensity);
      std::vector<std::uint32_t>& ranges = range_mm.emplace_back();
      for (std::size_t row = 0; row < n; ++row) ranges.push_back(raw[row] * 16U - fine[row]);
      reflectivity.push_back(std::move(intensity));
      const ouster::ColumnHead head = unit_.format.head(payload.bytes.data(), column);
      for (int byte = 0; byte < 8; ++byte) {
        ours["TIMESTAMP"] += static_cast<char>(head.stamp_ns >> (8 * byte) & 0xFF);
      }
      for (int byte = 0; byte < 2; ++byte) {
        ours["MEASUREMENT_ID"] += static_cast<char>(head.measurement >> (8 * byte) & 0xFF);
      }
    }
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t column = 0; column < range_mm.size(); ++column) {
        for (int byte = 0; byte < 4; ++byte) {
          ours["RANGE"] += static_cast<char>(range_mm[column][row] >> (8 * byte) & 0xFF);
        }
        ours["REFLECTIVITY"] += static_cast<char>(reflectivity[column][row]);
      }
    }
  }
  for (const auto& [name, wanted] : digest.items()) {
    EXPECT_EQ(test::md5_hex(plain[name]), wanted.get<std::string>()) << name;
  }
  // The capture is one frame: its image has the packets' columns side by side.
  ASSERT_EQ(all_digests.at("scans").size(), 1U);
  for (const auto& [name, wanted] : all_digests.at("scans")[0].items()) {
    const auto field = ouster_sheet_of(unit_.format.profile).find(name);
    if (!field) continue;
    const std::size_t row_bytes = static_cast<std::size_t>(columns * field->bytes);
    std::string image;
    for (int row = 0; row < rows; ++row) {
      for (std::size_t packet = 0; packet < payloads_.size(); ++packet) {
        image += plain[name].substr(
            (packet * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row)) * row_bytes,
            row_bytes);
      }
    }
    EXPECT_EQ(test::md5_hex(image), wanted.get<std::string>()) << name << " of the frame";
  }
  for (const auto& [name, bytes] : ours) {
    EXPECT_EQ(test::md5_hex(bytes), digest.at(name).get<std::string>())
        << name << " of the decoder";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealOuster,
    testing::Values(RealCapture{"Os0", "OS-0-128-U1_v2.3.0_1024x10", "OS-0-128-U1_v2.3.0_1024x10",
                                64, 97'299, true},
                    RealCapture{"Os1ThreeFrames", "OS-1-128_v2.3.0_1024x10_lb_n3",
                                "OS-1-128_v2.3.0_1024x10", 192, 322'536},
                    RealCapture{"Os1OfOldFirmware", "OS-1-64_1024x10_fw20",
                                "OS-1-64_sensor_config_reduced", 64, 16'749},
                    RealCapture{"Os1FunctionalSafety", "OS-1-128_767798045_1024x10_20230712_120049",
                                "OS-1-128_767798045_1024x10_20230712_120049", 8, 17'462},
                    RealCapture{"Os2", "OS-2-128-U1_v2.3.0_1024x10", "OS-2-128-U1_v2.3.0_1024x10",
                                64, 119'682, true}),
    [](const auto& capture) { return std::string(capture.param.name); });

}  // namespace
}  // namespace terracut::reference
