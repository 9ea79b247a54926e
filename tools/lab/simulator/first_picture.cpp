// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A labelled turn to look at while the rest of the program is still being compiled, for
// ./tools/demo:
//
//   terracut_first_picture FOLDER
//
// simulates an HDL-64E in a street, labels its packets, and draws a turn from above and as the
// sensor sees it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <thread>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/pictures/bird_eye_picture.hpp"
#include "pipeline/pictures/range_image_picture.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace {

using namespace terracut;
using Encoder = packets::Hdl64eEncoderTraits;

Status simulate(const simulator::SimulationConfig<Encoder>& config,
                const std::filesystem::path& pcap) {
  auto writer = drive::DriveWriter<Encoder>::create(pcap, config.calibration, config.sensor);
  if (!writer) return tl::unexpected(writer.error());
  const auto simulated =
      simulator::simulate_drive(config, [&](const simulator::SimulatedColumn<Encoder>& column) {
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      });
  if (!simulated) return tl::unexpected(simulated.error());
  const auto written = writer->finish();
  return written ? Status() : tl::unexpected(written.error());
}

Status draw(const frame::RangeImage& image, std::span<const frame::Label> labels,
            const std::filesystem::path& folder) {
  const pictures::LabelledFrame frame{image, labels, {}};
  if (Status drawn = pictures::bird_eye_picture(frame).write_png(folder / "first.birdseye.png");
      !drawn) {
    return drawn;
  }
  return pictures::range_image_picture(frame).write_png(folder / "first.range.png");
}

/// Labels a capture's first whole turn, and draws it.
Status draw_first_turn(const simulator::SimulationConfig<Encoder>& config,
                       const std::filesystem::path& pcap) {
  auto source = capture::CaptureSource::open(pcap);
  if (!source) return tl::unexpected(source.error());
  const calib::SensorCalibration unit(config.calibration);
  memory::FixedMemory memory;
  run::PacketPipeline pipeline(unit, calib::ring_profile(unit, config.mount), {},
                               ground::turn_maker_of({}), memory,
                               run::PacketPipeline::Makes::kPoints);
  while (true) {
    const auto datagram = source->next();
    if (!datagram) return tl::unexpected(datagram.error());
    if (!*datagram) return fail(ErrorCode::kInvalidArgument, "no whole turn was simulated");
    pipeline.push(**datagram);
    while (const run::Frame* frame = pipeline.next()) {
      if (frame->record.info.complete)
        return draw(*frame->image, pipeline.labels(), pcap.parent_path());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: terracut_first_picture FOLDER\n", stderr);
    return EXIT_FAILURE;
  }
  const std::filesystem::path pcap = std::filesystem::path(argv[1]) / "first.pcap";
  simulator::SimulationConfig<Encoder> config;
  config.duration_s = 0.3;
  config.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 64U));
  const Status drawn =
      simulate(config, pcap).and_then([&] { return draw_first_turn(config, pcap); });
  if (drawn) return EXIT_SUCCESS;
  std::fprintf(stderr, "error: %s\n", drawn.error().message.c_str());
  return EXIT_FAILURE;
}
