// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/motion/vehicle_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "calib/angle.hpp"
#include "rt/whole_file.hpp"

namespace terracut::firmware_io {
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
constexpr std::uint32_t kMotionId = 416;

/// Hundredths as the two's complement that is on the bus.
std::uint16_t hundredths(double value) {
  return static_cast<std::uint16_t>(
      static_cast<std::int16_t>(std::lround(std::clamp(100 * value, -32767.0, 32767.0))));
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

std::string vehicle_log(std::span<const MotionSample> samples) {
  std::string text;
  std::uint8_t counter = 0;
  for (const MotionSample& sample : samples) {
    const std::int64_t stamp_us = (sample.stamp_ns + 500) / 1000;
    fmt::format_to(std::back_inserter(text),
                   "({:010}.{:06}) can0 {:03X}#{:04X}{:04X}000000{:02X}\n", stamp_us / 1'000'000,
                   stamp_us % 1'000'000, kMotionId, hundredths(3.6 * sample.speed_mps),
                   hundredths(calib::rad_to_deg(sample.yaw_rate_radps)), counter++);
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
                         std::span<const MotionSample> samples) {
  if (Status written = rt::write_whole_file(can_dbc_path_of(pcap_path), vehicle_dbc()); !written) {
    return written;
  }
  return rt::write_whole_file(can_log_path_of(pcap_path), vehicle_log(samples));
}

}  // namespace terracut::firmware_io
