// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes as an MCAP file, and as a message of each kind that is read: no crash, no read outside
// the bytes, no endless loop, the same messages from the beginning again. Aborts when one of these
// does not hold.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "firmware_io/bag/bag_file.hpp"
#include "firmware_io/bag/packet_messages.hpp"
#include "firmware_io/bag/transform_tree.hpp"
#include "pipeline/api/point_buffer.hpp"
#include "pipeline/ros_messages/cloud_message.hpp"

namespace {

using namespace terracut;

unsigned touch(std::span<const std::byte> bytes) {
  unsigned sum = 0;
  for (const std::byte byte : bytes) sum += static_cast<unsigned>(byte);
  return sum;
}

struct Sum {
  std::size_t messages = 0;
  unsigned bytes = 0;
  friend bool operator==(const Sum&, const Sum&) = default;
};

Sum read(bag::BagFile& file) {
  const std::vector<bool> all(file.topics().size(), true);
  Sum sum;
  for (auto next = file.next(all); next && *next; next = file.next(all)) {
    ++sum.messages;
    sum.bytes += touch((*next)->bytes);
  }
  return sum;
}

unsigned read_as_messages(std::span<const std::byte> bytes) {
  unsigned touched = 0;
  std::vector<bag::PacketInMessage> packets;
  for (const char* const type :
       {"velodyne_msgs/msg/VelodyneScan", "pandar_msgs/msg/PandarScan",
        "nebula_msgs/msg/NebulaPackets", "ouster_sensor_msgs/msg/PacketMsg",
        "rslidar_msg/msg/RslidarPacket", "rslidar_msg/msg/RslidarScan"}) {
    (void)bag::read_packets(type, {0, 0, {}, bytes}, packets);
    for (const bag::PacketInMessage& packet : packets) {
      if (packet.stamp_ns < 0) std::abort();
      touched += touch(std::as_bytes(packet.payload));
    }
  }
  bag::TransformTree tree;
  tree.add(bytes);
  for (const std::string& frame : tree.frames()) (void)tree.transform(frame, "base_link");
  ros_messages::CloudMessage message;
  cloud::Cloud cloud;
  if (message.read(bytes) && unpack(message.buffer, cloud)) {
    touched += static_cast<unsigned>(cloud.points.size());
  }
  return touched;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  unsigned touched = read_as_messages(bytes);
  auto file = bag::open_mcap(bytes, "fuzz");
  if (!file) return touched == ~0U ? 1 : 0;
  const Sum first = read(**file);
  if (!(*file)->seek({}) || read(**file) != first) std::abort();
  return first.bytes + touched == ~0U ? 1 : 0;
}
