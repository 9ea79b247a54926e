// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/stream_names.hpp"

#include <gtest/gtest.h>

namespace terracut::streams {
namespace {

constexpr std::uint32_t kFront = 0xC0A801C9, kRear = 0xC0A80107;  // 192.168.1.201 and .7

SensorStream vlp16() {
  return {.source_address = kFront,
          .model = sensor::SensorModel::kVlp16,
          .destinations = {{.address = kRear, .port = 2368, .vlan = 0}},
          .packets = 100};
}

TEST(StreamNames, ChooseByTheFewestMarksThatTellSensorsApart) {
  std::vector<SensorStream> sensors{vlp16(), vlp16()};
  sensors[1].destinations[0].port = 2369;
  EXPECT_EQ(choice_text(sensors, HeardIn::kCapture),
            "Velodyne VLP-16 at 192.168.1.201 to port 2368, Velodyne VLP-16 at 192.168.1.201 to "
            "port 2369; choose one with --port 2368 or --port 2369");
  sensors[1].source_address = kRear;
  EXPECT_EQ(choice_text(sensors, HeardIn::kCapture),
            "Velodyne VLP-16 at 192.168.1.201, Velodyne VLP-16 at 192.168.1.7; choose one with "
            "--from 192.168.1.201 or --from 192.168.1.7");
}

TEST(StreamNames, OfALiveRunAreChosenByTheOptionsItHas) {
  std::vector<SensorStream> sensors{vlp16(), vlp16()};
  sensors[1].destinations[0].address = kFront;
  EXPECT_EQ(names_of(sensors, HeardIn::kLiveRun)[0].options, "--listen 192.168.1.7:2368");
  EXPECT_EQ(names_of(sensors, HeardIn::kCapture)[0].options, "--to 192.168.1.7");
  for (SensorStream& sensor : sensors) sensor.destinations[0].address = kRear;
  sensors[0].source_port = 50'001;
  sensors[1].source_port = 50'002;
  EXPECT_EQ(names_of(sensors, HeardIn::kLiveRun)[1].options, "--from 192.168.1.201:50002");
}

TEST(StreamNames, OfAnHdl64eOfAnyGenerationIsTheModelThatIsAskedFor) {
  std::vector<SensorStream> sensors{vlp16(), vlp16()};
  sensors[1].model = sensor::SensorModel::kHdl64eS1;
  EXPECT_EQ(names_of(sensors, HeardIn::kCapture)[1].options, "--sensor hdl64e");
}

}  // namespace
}  // namespace terracut::streams
