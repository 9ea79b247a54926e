// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/unknown_packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/hesai_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::sensor {
namespace {

struct Known {
  std::size_t number;
  std::string_view of;
};
/// The ports that lidar makers name in their factory settings and manuals.
constexpr std::array kPorts{Known{2368, "Velodyne or Hesai"},
                            Known{7502, "Ouster"},
                            Known{7503, "Ouster (its IMU)"},
                            Known{6699, "RoboSense"},
                            Known{7788, "RoboSense (about the sensor)"},
                            Known{56300, "Livox"},
                            Known{56301, "Livox"},
                            Known{57000, "Livox"}};
constexpr std::array kSizes{
    Known{568, "Hesai PandarXT-16"},   Known{861, "Hesai OT128 or Pandar128"},
    Known{893, "Hesai OT128"},         Known{1072, "Hesai PandarQT"},
    Known{1080, "Hesai PandarXT-32"},  Known{1118, "Hesai AT128"},
    Known{1194, "Hesai Pandar64"},     Known{1210, "RoboSense M1"},
    Known{1262, "Hesai Pandar40P"},    Known{1266, "Hesai Pandar40P"},
    Known{1318, "Livox Mid-40"},       Known{1362, "Livox Avia, Horizon or Tele-15"},
    Known{1380, "Livox Mid-360"},      Known{3392, "Ouster of 16 rows"},
    Known{6464, "Ouster of 32 rows"},  Known{8448, "Ouster of 128 rows"},
    Known{12608, "Ouster of 64 rows"}, Known{24896, "Ouster of 128 rows"}};

template <std::size_t kCount>
std::string_view one_of(const std::array<Known, kCount>& known, std::size_t number) {
  const auto found = std::ranges::find(known, number, &Known::number);
  return found == known.end() ? std::string_view() : found->of;
}

using Bytes = std::span<const std::uint8_t>;

std::size_t little_endian_16(Bytes payload, std::size_t at) {
  return payload[at] + 256U * payload[at + 1];
}

/// Describes a packet with the header of Hesai's later models, which states lasers and blocks: its
/// number of lasers is that of one whose packets are read, or of none.
std::string hesai_header(Bytes payload) {
  constexpr std::size_t kHeaderBytes = 12, kLasersAt = 6, kBlocksAt = 7;
  if (payload.size() < kHeaderBytes || !std::ranges::equal(payload.first(2), hesai::kPacketStart)) {
    return {};
  }
  std::string text =
      fmt::format("of a Hesai that is not read: {} lasers in {} blocks, protocol {}.{}",
                  payload[kLasersAt], payload[kBlocksAt], payload[2], payload[3]);
  if (const auto of = one_of(kSizes, payload.size()); !of.empty()) {
    text += fmt::format(", the size of a {}'s", of);
  }
  std::string near;
  for (const hesai::PacketLayout& layout : hesai::kLayouts) {
    if (layout.header_bytes != kHeaderBytes || layout.lasers != payload[kLasersAt]) continue;
    near += fmt::format("{}{} ({} bytes)", near.empty() ? "" : ", ", to_string(layout.model),
                        layout.packet_bytes());
  }
  return near.empty() ? text : text + "; of as many lasers are read: " + near;
}

/// Describes a packet of Livox's second protocol, which states its length and its points, or of
/// the first, which the length of a point tells.
std::string livox_header(Bytes payload) {
  constexpr std::size_t kHeaderBytes = 36, kOldHeaderBytes = 18;
  constexpr std::array<std::size_t, 4> kPointBytes{24, 14, 8, 10};  // by data type; 0 is the IMU's
  constexpr std::array<std::size_t, 6> kOldPointBytes{13, 9, 14, 10, 28, 16};
  constexpr std::size_t kTypeAt = 10, kOldTypeAt = 9, kOldVersion = 5;
  if (payload.size() > kHeaderBytes && payload[0] == 0 && payload[kTypeAt] < kPointBytes.size() &&
      little_endian_16(payload, 1) == payload.size() &&
      kHeaderBytes + little_endian_16(payload, 5) * kPointBytes[payload[kTypeAt]] ==
          payload.size()) {
    return payload[kTypeAt] == 0 ? "of a Livox's IMU"
                                 : "of a Livox (Mid-360 or HAP), which has no rows";
  }
  if (payload.size() > kOldHeaderBytes && payload[0] == kOldVersion &&
      payload[kOldTypeAt] < kOldPointBytes.size() && payload.size() > 900 &&
      (payload.size() - kOldHeaderBytes) % kOldPointBytes[payload[kOldTypeAt]] == 0) {
    return "of a Livox (Mid-40, Mid-70, Horizon, Tele-15 or Avia), which has no rows";
  }
  return {};
}

/// Describes a packet that starts as RoboSense's do and has not the size of a rotating one's.
std::string robosense_header(Bytes payload) {
  constexpr std::array<std::uint8_t, 4> kSolidState{0x55, 0xAA, 0x5A, 0xA5};
  constexpr std::array<std::uint8_t, 3> kRotating{0x55, 0xAA, 0x05};
  if (payload.size() < kSolidState.size()) return {};
  if (std::ranges::equal(payload.first(4), kSolidState)) {
    return "of a RoboSense without rows (M1, M2, E1 or of their kind)";
  }
  if (!std::ranges::equal(payload.first(3), kRotating)) return {};
  return fmt::format(
      "of a RoboSense that is not read; of the rotating ones' 1248 bytes only those of a {}, {} or "
      "{} are",
      to_string(SensorModel::kRuby128), to_string(SensorModel::kRs32),
      to_string(SensorModel::kHelios));
}

/// Describes a packet of a known model that lies inside the payload, between other bytes.
std::string packet_inside(std::span<const std::uint8_t> payload) {
  constexpr std::size_t kMostAround = 64;
  for (const std::size_t size : {hdl64e::kHdl64ePacketBytes, ruby128::kRubyPacketBytes}) {
    if (payload.size() <= size || payload.size() > size + kMostAround) continue;
    const std::size_t around = payload.size() - size;
    for (std::size_t before = 0; before <= around; ++before) {
      const auto model = sensor::recognise_sensor(payload.subspan(before, size));
      if (!is_decoded(model)) continue;
      return fmt::format(
          "packets of a {} with {} bytes before and {} behind them (user_layer_bytes and "
          "tail_layer_bytes of rs_driver?), which have to be sent without",
          to_string(model), before, around - before);
    }
  }
  return {};
}

}  // namespace

std::string guess_of_unknown(const packet::Datagram& datagram) {
  for (const auto describe : {packet_inside, hesai_header, livox_header, robosense_header}) {
    if (std::string found = describe(datagram.payload); !found.empty()) return found;
  }
  const std::string_view by_port = one_of(kPorts, datagram.destination_port);
  const std::string_view by_size = one_of(kSizes, datagram.payload.size());
  if (by_port.empty() && by_size.empty()) return {};
  if (by_port.empty()) return fmt::format("of {} by size?", by_size);
  if (by_size.empty()) return fmt::format("of {} by port?", by_port);
  return fmt::format("of {} by port, {} by size?", by_port, by_size);
}

}  // namespace terracut::sensor
