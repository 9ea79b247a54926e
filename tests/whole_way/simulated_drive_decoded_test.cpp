// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// From the simulated world through packets and a capture to the decoder: every return arrives, in
// the order of the truth, where the world has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/tools/lab/drive/made_drive.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {
namespace {

namespace fs = std::filesystem;

/// Returns of a frame by number of arrival.
std::vector<frame::Return> arrivals(const frame::RangeImage& image) {
  std::vector<frame::Return> returns(image.returns());
  for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
    if (!image.has_return(cell)) continue;
    returns[image.return_index()[cell]] = {image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                                           image.ground_range_m()[cell], image.intensity()[cell]};
  }
  for (const auto& extra : image.overflow()) returns[extra.return_index] = extra.point;
  return returns;
}

struct Measured {
  beams::Point exact;
  packets::LabelledReturn wire;
};

class SimulatedDriveDecoded : public test::InScratchFolder {
 protected:
  /// Writes one frame of the world and returns what was measured, in order of arrival.
  template <class EncoderTraits>
  std::vector<Measured> write(const simulator::SimulationConfig<EncoderTraits>& config) {
    auto writer =
        drive::DriveWriter<EncoderTraits>::create(pcap(), config.calibration, config.sensor);
    EXPECT_TRUE(writer) << writer.error().message;
    std::vector<Measured> measured;
    const auto done = simulator::simulate_drive(
        config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) -> Status {
          for (std::size_t i = 0; i < column.exact.size(); ++i) {
            const packets::LabelledReturn& wire = column.wire.by_laser[i];
            if (wire.raw != 0) measured.push_back({column.exact[i], wire});
          }
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        });
    EXPECT_TRUE(done) << done.error().message;
    const auto written = writer->finish();
    EXPECT_TRUE(written) << written.error().message;
    EXPECT_EQ(written->frames, 1U);
    EXPECT_EQ(written->returns, measured.size());
    return measured;
  }

  /// Decodes with the table beside the capture; returns the worst distance from where it was.
  template <class EncoderTraits>
  double worst_error_m(const simulator::SimulationConfig<EncoderTraits>& config,
                       const std::vector<Measured>& measured) {
    const auto calibration = test::table_beside<EncoderTraits>(pcap());
    EXPECT_TRUE(calibration) << calibration.error().message;
    decode::Decoder::Config settings;
    settings.columns = packets::image_columns<EncoderTraits>(config.spin_hz, config.sensor.returns);
    memory::FixedMemory memory;
    decode::Decoder decoder(*calibration, config.mount, settings, memory);
    const mount::RigidTransform T = mount::T_vehicle_lidar(config.mount);
    double worst_m = 0;
    int frames = 0;
    std::size_t wrong_intensities = 0;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::RangeImage& image) noexcept {
      ++frames;
      EXPECT_TRUE(info.complete);
      const auto seen = arrivals(image);
      EXPECT_EQ(seen.size(), measured.size());
      for (std::size_t i = 0; i < std::min(seen.size(), measured.size()); ++i) {
        const beams::Point& exact = measured[i].exact;
        const auto at = mount::apply(T, exact.x_m, exact.y_m, exact.z_m);
        worst_m = std::max(
            worst_m, std::hypot(seen[i].x_m - at[0], seen[i].y_m - at[1], seen[i].z_m - at[2]));
        wrong_intensities += seen[i].intensity != measured[i].wire.intensity ? 1 : 0;
      }
    };
    auto source = capture::CaptureSource::open(pcap());
    EXPECT_TRUE(source);
    for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
      test::decode(decoder, **datagram, on_frame);
    }
    test::end_stream(decoder, on_frame);
    EXPECT_EQ(frames, 1);
    EXPECT_EQ(wrong_intensities, 0U);
    EXPECT_EQ(decoder.losses().overflow_full_returns, 0U);
    EXPECT_EQ(decoder.losses().network_gap_packets, 0U);
    return worst_m;
  }

  void expect_truth_of(const std::vector<Measured>& measured) {
    std::vector<std::uint32_t> truth;
    ASSERT_TRUE(scan::read_label_file(drive::truth_folder_of(pcap()) / "000000.label",
                                      measured.size(), truth));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) wrong += truth[i] != measured[i].wire.truth;
    EXPECT_EQ(wrong, 0U);
  }

  template <class EncoderTraits>
  void expect_whole(packets::ReturnMode returns, double spin_hz, double allowed_m) {
    SCOPED_TRACE(std::to_string(packets::returns_per_firing(returns)) + " returns at " +
                 std::to_string(spin_hz) + " Hz");
    simulator::SimulationConfig<EncoderTraits> config;
    config.spin_hz = spin_hz;
    config.duration_s = 1 / spin_hz;
    config.threads = 2;
    config.mount = {.height_m = 1.9, .roll_rad = 0.01, .pitch_rad = 0.02};
    config.sensor.returns = returns;
    config.calibration = packets::unit_in_mode<EncoderTraits>(config.calibration, returns, spin_hz);
    const auto measured = write(config);
    // A third of the rays at least.
    const auto firings = static_cast<std::size_t>(
        1e9 / (spin_hz * static_cast<double>(
                             packets::firing_ns<EncoderTraits>(config.calibration, returns))));
    EXPECT_GT(measured.size(), firings * EncoderTraits::kLasers / 3);
    expect_truth_of(measured);
    EXPECT_LT(worst_error_m(config, measured), allowed_m);
  }

  [[nodiscard]] fs::path pcap() const { return folder_ / "drive.pcap"; }
};

/// Half a count of the wire, and a little for single precision.
constexpr double kRubyRounding_m = 0.0027, kHdlRounding_m = 0.0013, kFourMmRounding_m = 0.0022;

TEST_F(SimulatedDriveDecoded, EveryReturnOfAnRsRuby128ArrivesWhereItWas) {
  expect_whole<packets::Ruby128EncoderTraits>(packets::ReturnMode::kSingle, 10, kRubyRounding_m);
  expect_whole<packets::Ruby128EncoderTraits>(packets::ReturnMode::kSingle, 20, kRubyRounding_m);
}

TEST_F(SimulatedDriveDecoded, BothReturnsOfAnRsRuby128ArriveWhereTheyWere) {
  expect_whole<packets::Ruby128EncoderTraits>(packets::ReturnMode::kDual, 10, kRubyRounding_m);
  expect_whole<packets::Ruby128EncoderTraits>(packets::ReturnMode::kDual, 5, kRubyRounding_m);
}

TEST_F(SimulatedDriveDecoded, BothReturnsOfAnHdl64eArriveWhereTheyWere) {
  expect_whole<packets::Hdl64eEncoderTraits>(packets::ReturnMode::kDual, 10, kHdlRounding_m);
  expect_whole<packets::Hdl64eEncoderTraits>(packets::ReturnMode::kDual, 20, kHdlRounding_m);
}

TEST_F(SimulatedDriveDecoded, EveryReturnOfAVelodyneWithABuiltInTableArrivesWhereItWas) {
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vlp16>>(packets::ReturnMode::kSingle, 10,
                                                                kHdlRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Hdl32e>>(packets::ReturnMode::kSingle, 20,
                                                                 kHdlRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vlp32c>>(packets::ReturnMode::kSingle, 10,
                                                                 kFourMmRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vls128>>(packets::ReturnMode::kSingle, 20,
                                                                 kFourMmRounding_m);
}

TEST_F(SimulatedDriveDecoded, BothReturnsOfAVelodyneWithABuiltInTableArriveWhereTheyWere) {
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vlp16>>(packets::ReturnMode::kDual, 20,
                                                                kHdlRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Hdl32e>>(packets::ReturnMode::kDual, 10,
                                                                 kHdlRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vlp32c>>(packets::ReturnMode::kDual, 20,
                                                                 kFourMmRounding_m);
  expect_whole<packets::VelodyneEncoderTraits<velodyne::Vls128>>(packets::ReturnMode::kDual, 10,
                                                                 kFourMmRounding_m);
}

TEST_F(SimulatedDriveDecoded, EveryReturnOfAnOusterArrivesWhereItWas) {
  expect_whole<packets::OusterEncoderTraits<32>>(packets::ReturnMode::kSingle, 20, kHdlRounding_m);
  expect_whole<packets::OusterEncoderTraits<64>>(packets::ReturnMode::kSingle, 5, kHdlRounding_m);
  expect_whole<packets::OusterEncoderTraits<128>>(packets::ReturnMode::kSingle, 10, kHdlRounding_m);
}

TEST_F(SimulatedDriveDecoded, BothReturnsOfAnOusterArriveWhereTheyWere) {
  expect_whole<packets::OusterEncoderTraits<32>>(packets::ReturnMode::kDual, 5, kHdlRounding_m);
  expect_whole<packets::OusterEncoderTraits<128>>(packets::ReturnMode::kDual, 20, kHdlRounding_m);
}

}  // namespace
}  // namespace terracut::whole_way
