// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A simulated drive labelled twice: from its packets, and from the simulator's own returns put into
// range images without packets, by the scalar geometry in double precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/support/hand_out.hpp"
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {
namespace {

using frame::Label;

/// A frame's returns and labels in order of arrival.
struct LabelledFrame {
  std::vector<frame::Return> returns;
  std::vector<Label> labels;
};

struct TwoWays {
  explicit TwoWays(const simulator::Hdl64eSimulation& config)
      : decoder(config.calibration, config.mount, {}, memory),
        geometry(config.calibration),
        offsets(config.calibration),
        rows(rows_by_elevation(config.calibration)),
        T(mount::T_vehicle_lidar(config.mount)),
        segmenter(ground::terracut_profile(), ring_profile(config.calibration, config.mount),
                  decoder.shape(), 2 * decoder.shape().cells(), memory) {}

  LabelledFrame label(const frame::RangeImage& image) {
    (void)segmenter.segment(image);
    LabelledFrame frame;
    frame.labels.assign(segmenter.labels().begin(), segmenter.labels().end());
    frame.returns.resize(image.returns());
    for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
      if (!image.has_return(cell)) continue;
      frame.returns[image.return_index()[cell]] = {image.x_m()[cell], image.y_m()[cell],
                                                   image.z_m()[cell], image.ground_range_m()[cell],
                                                   image.intensity()[cell]};
    }
    for (const frame::OverflowReturn& extra : image.overflow()) {
      frame.returns[extra.return_index] = extra.point;
    }
    return frame;
  }

  auto on_frame() {
    return [this](const frame::FrameInfo&, const frame::RangeImage& image) noexcept {
      by_packets.push_back(label(image));
    };
  }

  void send(const std::array<packets::FiringColumn, hdl64e::kColumnsPerPacketSingle>& columns) {
    hdl64e::wire::Packet packet = hdl64e::blank_packet();
    packets::encode_hdl64e_packet(columns, packets::packet_end_ns(columns), {}, packet);
    const auto rejected = test::decode(
        decoder, packet::Datagram{hdl64e::payload_of(packet), columns.back().stamp_ns}, on_frame());
    ASSERT_FALSE(rejected.has_value()) << to_string(*rejected);
  }

  void put_directly(
      const std::array<packets::FiringColumn, hdl64e::kColumnsPerPacketSingle>& columns) {
    const auto wire_cdeg = [&](std::size_t c) {
      return beams::wrap_cdeg(columns[c].unwrapped_azimuth_cdeg);
    };
    const std::int32_t step =
        hdl64e::column_step_ticks(wire_cdeg(0), wire_cdeg(columns.size() - 1));
    for (const packets::FiringColumn& column : columns) {
      for (int laser = 0; laser < hdl64e::kHdl64eLasers; ++laser) {
        const packets::LabelledReturn& measured = column.by_laser[static_cast<std::size_t>(laser)];
        if (measured.raw == 0) continue;
        const packet::BeamAzimuth beam =
            packet::beam_azimuth(column.unwrapped_azimuth_cdeg, offsets.offset_ticks(step, laser));
        const double rotor_rad = packet::firing_azimuth_rad(
            column.unwrapped_azimuth_cdeg, hdl64e::firing_advance_ticks(step, laser));
        const beams::Point sensor = geometry.point(laser, rotor_rad, measured.raw);
        const auto vehicle = mount::apply(T, sensor.x_m, sensor.y_m, sensor.z_m);
        auto& image = images[beam.frame];
        if (!image) {
          image =
              std::make_unique<frame::RangeImage>(decoder.shape(), decoder.shape().cells(), memory);
        }
        image->place(rows[static_cast<std::size_t>(laser)],
                     packet::column_of(beam.in_revolution_ticks, decoder.shape().columns),
                     {static_cast<float>(vehicle[0]), static_cast<float>(vehicle[1]),
                      static_cast<float>(vehicle[2]),
                      static_cast<float>(std::hypot(vehicle[0], vehicle[1])), 0});
      }
    }
  }

  memory::FixedMemory memory;
  decode::Decoder decoder;
  hdl64e::Hdl64eGeometry geometry;
  hdl64e::BeamOffsets offsets;
  std::array<int, hdl64e::kHdl64eLasers> rows;
  mount::RigidTransform T;
  ground::Segmenter segmenter;
  std::map<std::int64_t, std::unique_ptr<frame::RangeImage>> images;
  std::vector<LabelledFrame> by_packets;
};

class SimulatedDrive : public testing::TestWithParam<const char*> {};

TEST_P(SimulatedDrive, GetsTheSameLabelsThroughPacketsAndDirectly) {
  simulator::Hdl64eSimulation config;
  config.scene = GetParam();
  config.duration_s = 0.3;
  config.mount.pitch_rad = 0.02;
  TwoWays ways(config);
  std::array<packets::FiringColumn, hdl64e::kColumnsPerPacketSingle> columns;
  std::size_t filled = 0;
  const auto summary = simulator::simulate_drive(
      config, [&](const simulator::Hdl64eSimulatedColumn& column) -> Status {
        columns[filled++] = column.wire;
        if (filled == columns.size()) {
          ways.send(columns);
          ways.put_directly(columns);
          filled = 0;
        }
        return {};
      });
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  test::end_stream(ways.decoder, ways.on_frame());

  ASSERT_EQ(ways.by_packets.size(), 3U);
  ASSERT_EQ(ways.images.size(), 3U);
  std::size_t frame = 0, returns = 0;
  for (const auto& [number, image] : ways.images) {
    const LabelledFrame direct = ways.label(*image);
    const LabelledFrame& packets = ways.by_packets[frame++];
    ASSERT_EQ(direct.labels.size(), packets.labels.size());
    returns += direct.labels.size();
    std::size_t differing = 0;
    for (std::size_t i = 0; i < direct.labels.size(); ++i) {
      ASSERT_NEAR(direct.returns[i].x_m, packets.returns[i].x_m, 5e-4) << i;
      ASSERT_NEAR(direct.returns[i].y_m, packets.returns[i].y_m, 5e-4) << i;
      ASSERT_NEAR(direct.returns[i].z_m, packets.returns[i].z_m, 5e-4) << i;
      differing += direct.labels[i] != packets.labels[i];
    }
    EXPECT_EQ(differing, 0U) << "frame " << frame << " of " << direct.labels.size() << " returns";
  }
  EXPECT_EQ(returns, summary->returns);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, SimulatedDrive,
                         testing::Values("flat", "street", "highway", "rural", "hill"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace terracut::whole_way
