// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Every frame of a capture, labelled: packets_to_labels drive.pcap FOLDER
#include <iostream>
#include <string>
#include <terracut/decoder.hpp>
#include <terracut/outputs.hpp>
#include <terracut/packet_pipeline.hpp>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  auto capture = terracut::Capture::open(argv[1]);
  if (!capture) return std::cerr << capture.error().message << '\n', 1;
  if (!capture->calibration())
    return std::cerr << capture->calibration().error().message << '\n', 1;
  auto pipeline =
      terracut::PacketPipeline::make(*capture->calibration(), {.mount = {.height_m = 1.73}});
  if (!pipeline) return std::cerr << pipeline.error().message << '\n', 1;

  const auto write_frames = [&] {
    while (const terracut::Frame* frame = pipeline->next()) {
      const std::string file = argv[2] + ("/" + std::to_string(frame->number)) + ".pcd";
      if (auto written = terracut::write_pcd(file, *frame); !written) {
        std::cerr << written.error().message << '\n';
      }
    }
  };
  for (auto packet = capture->next(); packet && *packet; packet = capture->next()) {
    pipeline->push(**packet);
    write_frames();
  }
  pipeline->end_stream();
  write_frames();
}
