// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/sensor_loop.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/velodyne/models.hpp"
#include "tools/lab/drive/drive_writer.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::simulation {
namespace {

constexpr std::size_t kTurns = 3;
constexpr std::size_t kPacketBytes = SensorLoop::kMostPacketBytes;
constexpr std::size_t kBlockBytes = 100, kBlocks = 12, kAzimuthAt = 2, kStampAt = 1200;
constexpr std::int64_t kDeviceHour_us = 3'600'000'000;

template <class Value>
Value value_of(Expected<Value> value) {
  if (!value) throw std::runtime_error(value.error().message);
  return *std::move(value);
}

std::uint16_t azimuth_of(std::span<const std::uint8_t> packet) noexcept {
  return static_cast<std::uint16_t>(packet[kAzimuthAt] | packet[kAzimuthAt + 1] << 8);
}

/// Reads whole turns out of a capture, from the first packet of a turn on.
std::vector<SensorLoop::Packet> turns_in(const std::filesystem::path& capture,
                                         std::size_t packets_per_turn) {
  std::vector<SensorLoop::Packet> packets;
  auto source = value_of(capture::CaptureSource::open(capture));
  std::uint16_t before_cdeg = 0;
  for (auto datagram = source.next(); datagram && *datagram; datagram = source.next()) {
    const auto payload = (*datagram)->payload;
    if (payload.size() != kPacketBytes) continue;
    const std::uint16_t azimuth_cdeg = azimuth_of(payload);
    const bool begins = azimuth_cdeg < std::exchange(before_cdeg, azimuth_cdeg);
    if (packets.empty() && !begins) continue;
    if (packets.size() == kTurns * packets_per_turn) break;
    std::ranges::copy(payload, packets.emplace_back().begin());
  }
  if (packets.size() != kTurns * packets_per_turn) throw std::runtime_error("too few packets");
  return packets;
}

template <class EncoderTraits>
SensorLoop loop_of(std::size_t packets_per_turn) {
  constexpr auto kSingle = packets::ReturnMode::kSingle;
  simulator::SimulationConfig<EncoderTraits> setup;
  SensorLoop loop;
  loop.period_ns = EncoderTraits::firing_ns(kSingle) * EncoderTraits::columns_per_packet(kSingle);
  loop.packets_per_turn = packets_per_turn;
  setup.spin_hz = 1e9 / static_cast<double>(loop.turn_ns());
  setup.duration_s = static_cast<double>(kTurns) / setup.spin_hz;
  loop.calibration = setup.calibration;
  loop.profile = ring_profile(setup.calibration, setup.mount);
  loop.columns = packets::image_columns<EncoderTraits>(setup.spin_hz, kSingle);

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      ("terracut_simulation_" + std::to_string(::getpid()) + "_" + std::to_string(loop.columns));
  std::filesystem::create_directories(folder);
  const std::filesystem::path capture = folder / "drive.pcap";
  auto writer = value_of(drive::DriveWriter<EncoderTraits>::create(capture, setup.calibration));
  (void)value_of(simulator::simulate_drive(
      setup, [&](const simulator::SimulatedColumn<EncoderTraits>& column) {
        return writer.add_column(column.wire.stamp_ns, column.wire.unwrapped_azimuth_cdeg,
                                 column.wire.by_laser);
      }));
  (void)value_of(writer.finish());
  loop.packets = turns_in(capture, packets_per_turn);
  std::filesystem::remove_all(folder);
  return loop;
}

}  // namespace

const SensorLoop& vlp16_loop() {
  static const SensorLoop loop = loop_of<packets::VelodyneEncoderTraits<velodyne::Vlp16>>(75);
  return loop;
}

const SensorLoop& hdl64e_loop() {
  static const SensorLoop loop = loop_of<packets::Hdl64eEncoderTraits>(375);
  return loop;
}

void set_device_stamp(std::span<std::uint8_t> packet, std::int64_t device_us) noexcept {
  const std::int64_t stamp_us = (device_us % kDeviceHour_us + kDeviceHour_us) % kDeviceHour_us;
  for (std::size_t i = 0; i < 4; ++i) {
    packet[kStampAt + i] = static_cast<std::uint8_t>(stamp_us >> (8 * i));
  }
}

void stop_head(std::span<std::uint8_t> packet) noexcept {
  for (std::size_t block = 1; block < kBlocks; ++block) {
    std::ranges::copy_n(&packet[kAzimuthAt], 2, &packet[block * kBlockBytes + kAzimuthAt]);
  }
}

}  // namespace terracut::simulation
