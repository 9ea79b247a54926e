// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "pipeline/publish/labelled_frame.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/cli/options.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/packets/table_encoder_traits.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::cli {

inline constexpr double kFrame_s = 0.1;

/// A capture of eight frames of a VLP-16, with its truth beside it.
class EightFrames : public test::InScratchFolder {
 protected:
  using Traits = packets::VelodyneEncoderTraits<velodyne::Vlp16>;

  void SetUp() override {
    options_.capture.file = folder_ / "drive.pcap";
    options_.mount.height_m = 1.73;
    simulator::SimulationConfig<Traits> config;
    config.scene = "flat";
    config.duration_s = 8 * kFrame_s;
    auto writer = drive::DriveWriter<Traits>::create(options_.capture.file, config.calibration);
    ASSERT_TRUE(writer) << writer.error().message;
    const auto done = simulator::simulate_drive(
        config, [&](const simulator::SimulatedColumn<Traits>& column) -> Status {
          return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                    column.wire.by_laser);
        });
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_TRUE(writer->finish());
  }
  /// Writes a frame's points as a cloud in the sensor's frame.
  void write_cloud(const std::filesystem::path& path, const publish::LabelledFrame& frame) const {
    std::string text = fmt::format(
        "VERSION .7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH {0}\n"
        "HEIGHT 1\nPOINTS {0}\nDATA ascii\n",
        frame.points.size());
    for (const points::LabelledPoint& point : frame.points) {
      text += fmt::format("{} {} {} {}\n", point.x_m, point.y_m,
                          point.z_m - *options_.mount.height_m, point.row);
    }
    std::ofstream(path) << text;
  }

  Options options_;
};

}  // namespace terracut::cli
