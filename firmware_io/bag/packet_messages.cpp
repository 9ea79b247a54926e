// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/packet_messages.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "firmware_io/bag/cdr_reader.hpp"

namespace terracut::bag {
namespace {

using Packets = std::vector<PacketInMessage>;

PacketInMessage packet_of(std::span<const std::byte> bytes, std::int64_t stamp_ns) {
  return {{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, stamp_ns};
}

/// Header, then packets of a stamp and an array of `kBytes` bytes.
template <std::size_t kBytes>
void read_scan(CdrReader& from, Packets& packets) {
  (void)Header::read(from);
  for (std::size_t left = from.length(kBytes); left > 0; --left) {
    const std::int64_t stamp_ns = from.time_ns();
    const PacketInMessage packet = packet_of(from.bytes(kBytes), stamp_ns);
    if (from.failed()) return;
    packets.push_back(packet);
  }
}

/// Header, then packets of a stamp, an array of 1500 bytes, and how many of these are the packet's.
void read_pandar_scan(CdrReader& from, Packets& packets) {
  constexpr std::size_t kBytes = 1500;
  (void)Header::read(from);
  for (std::size_t left = from.length(kBytes); left > 0; --left) {
    const std::int64_t stamp_ns = from.time_ns();
    const std::span<const std::byte> data = from.bytes(kBytes);
    const std::size_t size = from.number<std::uint32_t>();
    if (size > kBytes) from.fail();
    if (from.failed()) return;
    packets.push_back(packet_of(data.first(size), stamp_ns));
  }
}

/// Header, then packets of a stamp and a sequence of bytes.
void read_nebula_packets(CdrReader& from, Packets& packets) {
  constexpr std::size_t kLeastBytes = 12;
  (void)Header::read(from);
  for (std::size_t left = from.length(kLeastBytes); left > 0; --left) {
    const std::int64_t stamp_ns = from.time_ns();
    const PacketInMessage packet = packet_of(from.byte_sequence(), stamp_ns);
    if (from.failed()) return;
    packets.push_back(packet);
  }
}

/// A sequence of bytes alone.
void read_ouster_packet(CdrReader& from, Packets& packets) {
  const PacketInMessage packet = packet_of(from.byte_sequence(), 0);
  if (!from.failed()) packets.push_back(packet);
}

/// Header, is_difop, is_frame_begin, and a sequence of bytes.
void read_rslidar_packet(CdrReader& from, Packets& packets) {
  const std::int64_t stamp_ns = Header::read(from).stamp_ns;
  (void)from.number<std::uint8_t>();
  (void)from.number<std::uint8_t>();
  const PacketInMessage packet = packet_of(from.byte_sequence(), stamp_ns);
  if (!from.failed()) packets.push_back(packet);
}

struct PacketType {
  std::string_view name;
  void (*read)(CdrReader&, Packets&);
};

constexpr std::array kPacketTypes{
    PacketType{"velodyne_msgs/msg/VelodyneScan", read_scan<1206>},
    PacketType{"pandar_msgs/msg/PandarScan", read_pandar_scan},
    PacketType{"nebula_msgs/msg/NebulaPackets", read_nebula_packets},
    PacketType{"ouster_msgs/msg/PacketMsg", read_ouster_packet},
    PacketType{"ouster_sensor_msgs/msg/PacketMsg", read_ouster_packet},
    PacketType{"ouster_ros/msg/PacketMsg", read_ouster_packet},
    PacketType{"rslidar_msg/msg/RslidarPacket", read_rslidar_packet},
    PacketType{"rslidar_msg/msg/RslidarScan", read_scan<1248>},
    PacketType{"rslidar_msgs/msg/RslidarScan", read_scan<1248>},
};

const PacketType* type_named(std::string_view name) {
  const auto found = std::ranges::find(kPacketTypes, name, &PacketType::name);
  return found == kPacketTypes.end() ? nullptr : &*found;
}

}  // namespace

bool holds_packets(std::string_view type) noexcept {
  return type_named(type) != nullptr;
}

bool read_packets(std::string_view type, const Message& message, Packets& packets) {
  packets.clear();
  const PacketType* const known = type_named(type);
  if (known == nullptr) return false;
  CdrReader from(message.bytes);
  known->read(from, packets);
  constexpr std::int64_t kLastStamp_ns = 9'000'000'000'000'000'000;  // as of a PcapRecord
  for (PacketInMessage& packet : packets) {
    if (packet.stamp_ns <= 0) packet.stamp_ns = std::min(message.stamp_ns, kLastStamp_ns);
  }
  return !from.failed();
}

}  // namespace terracut::bag
