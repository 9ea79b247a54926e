// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "firmware_io/bag/bag_file.hpp"

namespace terracut::bag {

/// A sensor's packet in a message of a ROS driver.
struct PacketInMessage {
  std::span<const std::uint8_t> payload;  ///< Points into the message.
  std::int64_t stamp_ns = 0;              ///< Nanoseconds since 1970, as of a PcapRecord.
};

/// True if messages of this type hold packets: velodyne_msgs' VelodyneScan, pandar_msgs'
/// PandarScan, nebula_msgs' NebulaPackets, PacketMsg of ouster_msgs, ouster_sensor_msgs and
/// ouster_ros, RslidarPacket and RslidarScan of rslidar_msg and rslidar_msgs.
[[nodiscard]] bool holds_packets(std::string_view type) noexcept;

/// Reads the packets of a message of such a type, replacing the content of `packets`. Packets
/// without a stamp get that of the message. False if the message is broken; `packets` then holds
/// those before the fault.
[[nodiscard]] bool read_packets(std::string_view type, const Message& message,
                                std::vector<PacketInMessage>& packets);

}  // namespace terracut::bag
