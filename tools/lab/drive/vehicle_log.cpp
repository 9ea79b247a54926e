// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "vehicle_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "calib/beams/angle.hpp"
#include "firmware_io/can/candump_line.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::drive {
namespace {

constexpr std::string_view kDbc =
    "VERSION \"\"\n"
    "\n"
    "NS_ :\n"
    "\n"
    "BS_:\n"
    "\n"
    "BU_: VEHICLE\n"
    "\n"
    "BO_ 416 VEHICLE_MOTION: 8 VEHICLE\n"
    " SG_ SPEED : 7|16@0- (0.01,0) [-327.68|327.67] \"km/h\" Vector__XXX\n"
    " SG_ YAW_RATE : 23|16@0- (0.01,0) [-327.68|327.67] \"deg/s\" Vector__XXX\n"
    " SG_ COUNTER : 63|8@0+ (1,0) [0|255] \"\" Vector__XXX\n"
    "\n"
    "CM_ BO_ 416 \"Motion of the vehicle that a drive was made for\";\n"
    "CM_ SG_ 416 SPEED \"Of the rear axle; backwards is negative\";\n"
    "CM_ SG_ 416 YAW_RATE \"To the left is positive\";\n";
constexpr can::CanId kMotionId{416, false};

/// Writes hundredths as two's complement, high byte first, as on the bus.
void put_hundredths(double value, std::span<std::uint8_t, 2> bytes) {
  const auto whole = static_cast<std::uint16_t>(
      static_cast<std::int16_t>(std::lround(std::clamp(100 * value, -32767.0, 32767.0))));
  bytes[0] = static_cast<std::uint8_t>(whole >> 8);
  bytes[1] = static_cast<std::uint8_t>(whole);
}

can::CanFrame motion_frame(const vehicle::MotionSample& sample, std::uint8_t counter) {
  can::CanFrame frame;
  frame.stamp_ns = (sample.stamp_ns + 500) / 1000 * 1000;
  frame.id = kMotionId;
  frame.length = 8;
  const std::span data(frame.data);
  put_hundredths(3.6 * sample.speed_mps, data.subspan<0, 2>());
  put_hundredths(beams::rad_to_deg(sample.yaw_rate_radps), data.subspan<2, 2>());
  data[7] = counter;
  return frame;
}

std::filesystem::path beside(const std::filesystem::path& pcap_path, const char* suffix) {
  std::filesystem::path name = pcap_path.stem();
  name += suffix;
  return pcap_path.parent_path() / name;
}

}  // namespace

std::string vehicle_dbc() {
  return std::string(kDbc);
}

std::string vehicle_log(std::span<const vehicle::MotionSample> samples) {
  std::string text;
  std::uint8_t counter = 0;
  for (const vehicle::MotionSample& sample : samples) {
    text += can::candump_line(motion_frame(sample, counter++), "can0");
  }
  return text;
}

std::filesystem::path can_log_path_of(const std::filesystem::path& pcap_path) {
  return beside(pcap_path, ".can.log");
}

std::filesystem::path can_dbc_path_of(const std::filesystem::path& pcap_path) {
  return beside(pcap_path, ".can.dbc");
}

Status write_vehicle_log(const std::filesystem::path& pcap_path,
                         std::span<const vehicle::MotionSample> samples) {
  if (Status written = files::write_whole_file(can_dbc_path_of(pcap_path), vehicle_dbc());
      !written) {
    return written;
  }
  return files::write_whole_file(can_log_path_of(pcap_path), vehicle_log(samples));
}

}  // namespace terracut::drive
