// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A turn segmented while its packets arrive, and the same turn at once: the labels are the same,
// whatever becomes of the packets on their way.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/sensor/sensor_decoder.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {
namespace {

namespace fs = std::filesystem;

struct Packet {
  std::vector<std::uint8_t> payload;
  std::int64_t stamp_ns;
  [[nodiscard]] decode::Datagram datagram() const { return {payload, stamp_ns}; }
};

/// Bits of what a column holds.
struct ColumnHash {
  std::size_t value = 0;
  ColumnHash(const frame::RangeImage& image, int column) {
    for (int row = 0; row < image.shape().rows; ++row) {
      const std::size_t cell = image.shape().cell(row, column);
      if (!image.has_return(cell)) continue;
      for (const float part : {static_cast<float>(row), image.x_m()[cell], image.y_m()[cell],
                               image.z_m()[cell], image.ground_range_m()[cell]}) {
        value = value * 1'000'003 + std::hash<float>{}(part);
      }
    }
  }
};

template <class Transmitter>
struct ArrivingTurn : testing::Test {
  static constexpr double kDuration_s = 0.35;

  static simulator::SimulationConfig<Transmitter> config() {
    simulator::SimulationConfig<Transmitter> config;
    config.scene = "street";
    config.duration_s = kDuration_s;
    config.threads = 2;
    return config;
  }

  ArrivingTurn()
      : decoder(setup.calibration, setup.mount, {}, memory),
        ahead(segmenter()),
        at_once(segmenter()) {}

  void SetUp() override {
    const fs::path folder = terracut::test::make_scratch_folder();
    const fs::path pcap = folder / "drive.pcap";
    auto writer = drive::DriveWriter<Transmitter>::create(pcap, setup.calibration, setup.sensor);
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(simulator::simulate_drive(
        setup, [&](const simulator::SimulatedColumn<Transmitter>& column) {
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        }));
    ASSERT_TRUE(writer->finish());
    auto source = capture::PcapSource::open(pcap);
    ASSERT_TRUE(source);
    for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
      const auto payload = (*datagram)->payload;
      sent.push_back({{payload.begin(), payload.end()}, (*datagram)->stamp_ns});
    }
    fs::remove_all(folder);
    ASSERT_GT(sent.size(), 300U);
  }

  std::unique_ptr<ground::Segmenter> segmenter() {
    return std::make_unique<ground::Segmenter>(ground::terracut_profile(), profile, decoder.shape(),
                                               decoder.return_capacity(), memory);
  }

  /// Decodes `packets`, segments every turn both ways and compares.
  void run(const std::vector<Packet>& packets) {
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::RangeImage& image) noexcept {
      (void)ahead->segment(image);
      (void)at_once->segment(image);
      EXPECT_TRUE(std::ranges::equal(ahead->labels(), at_once->labels())) << info.number;
      EXPECT_EQ(ahead->labels().size(), image.returns());
      check_settled(image);
      ++frames;
      complete += info.complete ? 1 : 0;
    };
    for (const Packet& packet : packets) {
      test::decode(decoder, packet.datagram(), on_frame);
      const auto arriving = decoder.arriving();
      if (arriving.image == nullptr) continue;
      ahead->advance(*arriving.image, arriving.settled_columns);
      if (arriving.image != settling) settled.clear();  // a turn without returns is no frame
      settling = arriving.image;
      most_settled = std::max(most_settled, arriving.settled_columns);
      for (auto column = static_cast<int>(settled.size()); column < arriving.settled_columns;
           ++column) {
        settled.emplace_back(*arriving.image, column);
      }
    }
    test::end_stream(decoder, on_frame);
  }
  /// Counts columns that were said to be settled and changed afterwards.
  void check_settled(const frame::RangeImage& image) {
    for (std::size_t i = 0; i < settled.size(); ++i) {
      changed += settled[i].value != ColumnHash(image, static_cast<int>(i)).value ? 1 : 0;
    }
    settled.clear();
  }

  const simulator::SimulationConfig<Transmitter> setup = config();
  std::vector<Packet> sent;
  memory::FixedMemory memory;
  mount::RingProfile profile = ring_profile(setup.calibration, setup.mount);
  sensor::SensorDecoder decoder;
  std::unique_ptr<ground::Segmenter> ahead, at_once;
  const frame::RangeImage* settling = nullptr;  // the oldest open turn
  std::vector<ColumnHash> settled;              // its settled columns
  int frames = 0, complete = 0, most_settled = 0, changed = 0;
};

using BothSensors = testing::Types<encode::Hdl64eTransmitter, encode::Ruby128Transmitter>;
TYPED_TEST_SUITE(ArrivingTurn, BothSensors);

TYPED_TEST(ArrivingTurn, IsLabelledAsAtOnce) {
  this->run(this->sent);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->changed, 0) << "what was said to be settled is";
  EXPECT_GT(this->most_settled, this->decoder.shape().columns * 19 / 20);
}

TYPED_TEST(ArrivingTurn, IsLabelledAsAtOnceWherePacketsComeInAnotherOrder) {
  auto packets = this->sent;
  for (std::size_t i = 20; i + 3 < packets.size(); i += 17) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 3]);  // by as many as is waited for
  }
  this->run(packets);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->changed, 0);
}

TYPED_TEST(ArrivingTurn, IsLabelledAsAtOnceWherePacketsComeMuchTooLate) {
  auto packets = this->sent;
  for (std::size_t i = 20; i + 45 < packets.size(); i += 60) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 40]);
  }
  this->run(packets);
  EXPECT_GE(this->frames, 3);
}

TYPED_TEST(ArrivingTurn, IsLabelledAsAtOnceWherePacketsAreLost) {
  auto packets = this->sent;
  packets.erase(packets.begin() + 100, packets.begin() + 140);
  this->run(packets);
  EXPECT_GE(this->frames, 3);
  EXPECT_EQ(this->changed, 0);
}

TYPED_TEST(ArrivingTurn, IsLabelledAsAtOnceAfterTheStreamHasBegunAgain) {
  this->run(this->sent);
  this->run(this->sent);
  EXPECT_GE(this->complete, 6);
  EXPECT_EQ(this->changed, 0);
}

TYPED_TEST(ArrivingTurn, HasNothingSettledWhereItsMotionWillBeTakenOut) {
  vehicle::EgoMotion motion({}, this->memory);
  sensor::SensorDecoder::Config config;
  config.motion = &motion;
  sensor::SensorDecoder deskewing(this->setup.calibration, this->setup.mount, config, this->memory);
  int most = 0;
  for (const Packet& packet : this->sent) {
    test::decode(deskewing, packet.datagram(),
                 [](const frame::FrameInfo&, const frame::RangeImage&) noexcept {});
    most = std::max(most, deskewing.arriving().settled_columns);
  }
  EXPECT_EQ(most, 0);
}

}  // namespace
}  // namespace terracut::whole_way
