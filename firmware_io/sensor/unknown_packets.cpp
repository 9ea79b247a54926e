// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/unknown_packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::sensor {
namespace {

struct Known {
  std::size_t number;
  std::string_view of;
};
/// The ports that lidar makers name in their factory settings and manuals.
constexpr Known kPorts[] = {{7502, "Ouster"},
                            {7503, "Ouster (its IMU)"},
                            {6699, "RoboSense"},
                            {56301, "Livox"},
                            {57000, "Livox"}};
constexpr Known kSizes[] = {
    {568, "Hesai PandarXT-16"},   {861, "Hesai OT128 or Pandar128"}, {893, "Hesai OT128"},
    {1072, "Hesai PandarQT"},     {1080, "Hesai PandarXT-32"},       {1118, "Hesai AT128"},
    {1194, "Hesai Pandar64"},     {1262, "Hesai Pandar40P"},         {1266, "Hesai Pandar40P"},
    {3392, "Ouster of 16 rows"},  {6464, "Ouster of 32 rows"},       {8448, "Ouster of 128 rows"},
    {12608, "Ouster of 64 rows"}, {24896, "Ouster of 128 rows"}};

std::string_view one_of(const Known* begin, const Known* end, std::size_t number) {
  const Known* const found =
      std::find_if(begin, end, [&](const Known& known) { return known.number == number; });
  return found == end ? std::string_view() : found->of;
}

/// Describes a packet of a known model that lies inside the payload, between other bytes.
std::string packet_inside(std::span<const std::uint8_t> payload) {
  constexpr std::size_t kMostAround = 64;
  for (const std::size_t size : {hdl64e::kHdl64ePacketBytes, ruby128::kRubyPacketBytes}) {
    if (payload.size() <= size || payload.size() > size + kMostAround) continue;
    const std::size_t around = payload.size() - size;
    for (std::size_t before = 0; before <= around; ++before) {
      const auto model = sensor::recognise_sensor(payload.subspan(before, size));
      if (model == SensorModel::kUnknown) continue;
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
  if (std::string inside = packet_inside(datagram.payload); !inside.empty()) return inside;
  std::string_view of = one_of(std::begin(kPorts), std::end(kPorts), datagram.destination_port);
  if (of.empty()) of = one_of(std::begin(kSizes), std::end(kSizes), datagram.payload.size());
  return of.empty() ? std::string() : fmt::format("of {}?", of);
}

}  // namespace terracut::sensor
