// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {

struct Packet {
  std::vector<std::uint8_t> payload;
  std::int64_t stamp_ns;
  [[nodiscard]] packet::Datagram datagram() const { return {payload, stamp_ns}; }
};

/// The packets of a simulated drive; none, and a failure, where it cannot be written.
template <class EncoderTraits>
std::vector<Packet> simulated_packets(const simulator::SimulationConfig<EncoderTraits>& setup) {
  std::vector<Packet> sent;
  const terracut::test::ScratchFolder folder;
  const std::filesystem::path pcap = folder / "drive.pcap";
  auto writer = drive::DriveWriter<EncoderTraits>::create(pcap, setup.calibration, setup.sensor);
  EXPECT_TRUE(writer) << writer.error().message;
  if (!writer) return sent;
  EXPECT_TRUE(simulator::simulate_drive(
      setup, [&](const simulator::SimulatedColumn<EncoderTraits>& column) {
        return writer->add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                  column.wire.by_laser);
      }));
  EXPECT_TRUE(writer->finish());
  auto source = capture::CaptureSource::open(pcap);
  EXPECT_TRUE(source);
  if (!source) return sent;
  for (auto datagram = source->next(); datagram && *datagram; datagram = source->next()) {
    const auto payload = (*datagram)->payload;
    sent.push_back({{payload.begin(), payload.end()}, (*datagram)->stamp_ns});
  }
  return sent;
}

}  // namespace terracut::whole_way
