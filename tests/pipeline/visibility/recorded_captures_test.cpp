// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/visibility/visibility.hpp"
#include "tests/support/places.hpp"

namespace terracut::visibility {
namespace {

using sensor::SensorModel;

struct Capture {
  const char* file;
  SensorModel model;
};
constexpr Capture kCaptures[]{{"pcap/sample_velodyne_hdl32.pcap", SensorModel::kHdl32e},
                              {"pcap/sample_velodyne_vlp16_gps.pcap", SensorModel::kVlp16},
                              {"pcap/vlp16_nebula.pcap", SensorModel::kVlp16},
                              {"pcap/vlp32_nebula.pcap", SensorModel::kVlp32c},
                              {"pcap/vls128_nebula.pcap", SensorModel::kVls128},
                              {"hesai/40p.pcap", SensorModel::kPandar40p},
                              {"hesai/64.pcap", SensorModel::kPandar64},
                              {"hesai/qt64.pcap", SensorModel::kPandarQt64},
                              {"hesai/xt32.pcap", SensorModel::kPandarXt32}};

/// Looks at every turn of a capture; returns how many there are. What is named fails the test.
int look_at(const std::filesystem::path& file, SensorModel model) {
  const mount::Mount mount;
  const calib::SensorCalibration unit = calib::nominal(model);
  memory::FixedMemory memory;
  decode::Decoder decoder(unit, mount, {}, memory);
  frame::PointImage points = decoder.point_image(memory);
  const mount::RingProfile profile = calib::ring_profile(unit, mount);
  ground::Segmenter method({}, profile, decoder.shape(), decoder.return_capacity(), memory);
  Visibility view({}, profile, decoder.shape(), memory);
  int turns = 0;
  const auto take_frames = [&] {
    while (const frame::Frame* frame = decoder.next()) {
      const frame::RangeImage& image = points.make(*frame->returns);
      // The first turn and the last one are not whole.
      if (image.returns() == 0 || frame->info.number == 0) continue;
      (void)method.segment(image);
      // A capture of a few turns is looked at as if the sensor stood there for longer.
      for (int again = 0; again < 6; ++again) {
        view.look(image, method.planes());
        EXPECT_EQ(view.worst(), Condition{})
            << "turn " << turns << ": " << to_string(view.worst().cause) << " in "
            << view.troubled_sectors() << " sectors";
      }
      ++turns;
    }
  };
  auto source = capture::CaptureSource::open(file);
  EXPECT_TRUE(source);
  while (source) {
    const auto next = source->next();
    if (!next || !*next) break;
    decoder.push(**next);
    take_frames();
  }
  return turns;
}

TEST(ViewOfRecordedCaptures, RaisesNoFalseAlarm) {
  for (const Capture& capture : kCaptures) {
    const std::filesystem::path file = test::shared_data(capture.file);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no captures: " << capture.file;
    SCOPED_TRACE(capture.file);
    EXPECT_GT(look_at(file, capture.model), 0);
  }
}

}  // namespace
}  // namespace terracut::visibility
