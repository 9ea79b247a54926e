// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_stream_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "calib/beams/angle.hpp"

namespace terracut::hdl64e {
namespace {

// Offsets in the table (HDL-64E S3 manual Rev K, pp. 33-38).
constexpr std::string_view kMagic = "UNIT#";
constexpr std::size_t kFirstLaser = 7;
constexpr std::size_t kLaserStride = 28;       ///< 21 bytes of laser, warning byte, 6 reserved.
constexpr std::size_t kCrcBytesPerLaser = 20;  ///< All but the laser's number.
constexpr std::size_t kWarning = 21;           ///< After the laser's first byte; not for laser 63.
constexpr std::size_t kDate = 256 * 7;
constexpr std::size_t kMotor = 257 * 7;
constexpr std::size_t kAddresses = 258 * 7 + 1;
constexpr std::size_t kReturnSetting = kAddresses + 8;
constexpr std::size_t kCheck = kStreamTableBytes - 2;

// Counts a unit. Dividing by them gives the doubles nearest to the decimal values, as files do.
constexpr double kPerDegree = 100;
constexpr double kPerMetre = 1000;
constexpr double kPerSlope = 10;

using Bytes = std::span<const std::uint8_t, kStreamTableBytes>;

constexpr std::size_t laser_at(std::size_t laser) {
  return kFirstLaser + kLaserStride * laser;
}

int unsigned16(Bytes bytes, std::size_t at) {
  return bytes[at] | (bytes[at + 1] << 8);
}
int signed16(Bytes bytes, std::size_t at) {
  const int value = unsigned16(bytes, at);
  return value < 0x8000 ? value : value - 0x10000;
}

std::optional<UnitInfo::CalibrationDate> date_from(Bytes bytes) {
  const auto part = bytes.subspan(kDate, 6);
  const bool plausible = part[1] >= 1 && part[1] <= 12 && part[2] >= 1 && part[2] <= 31 &&
                         part[3] < 24 && part[4] < 60 && part[5] < 60 && part[0] != 0xFF;
  if (!plausible) return std::nullopt;
  return UnitInfo::CalibrationDate{2000 + part[0], part[1], part[2], part[3], part[4], part[5]};
}

UnitInfo unit_from(Bytes bytes) {
  UnitInfo unit;
  unit.upper_noise_threshold = bytes[5];
  unit.lower_noise_threshold = bytes[6];
  for (std::size_t i = 0; i + 1 < kHdl64eLasers; ++i) {
    unit.warning_bits |= bytes[laser_at(i) + kWarning];
  }
  unit.calibration_date = date_from(bytes);
  unit.humidity_percent = bytes[kDate + 6];
  unit.motor_rpm = signed16(bytes, kMotor);
  unit.fov_start_cdeg = unsigned16(bytes, kMotor + 2);
  unit.fov_end_cdeg = unsigned16(bytes, kMotor + 4);
  unit.hours_run = unsigned16(bytes, kMotor + 6);
  std::copy_n(bytes.begin() + kAddresses, 4, unit.source_ip.begin());
  std::copy_n(bytes.begin() + kAddresses + 4, 4, unit.destination_ip.begin());
  unit.return_setting = bytes[kReturnSetting];
  unit.reserved_or_warning = bytes[kReturnSetting + 1];
  unit.power_level = bytes[kReturnSetting + 2];
  return unit;
}

Hdl64eLaser laser_from(Bytes bytes, std::size_t at) {
  Hdl64eLaser laser;
  laser.vert_correction_rad = beams::deg_to_rad(signed16(bytes, at + 1) / kPerDegree);
  laser.rot_correction_rad = beams::deg_to_rad(signed16(bytes, at + 3) / kPerDegree);
  laser.dist_correction_m = signed16(bytes, at + 5) / kPerMetre;
  laser.dist_correction_x_m = signed16(bytes, at + 7) / kPerMetre;
  laser.dist_correction_y_m = signed16(bytes, at + 9) / kPerMetre;
  laser.vert_offset_m = signed16(bytes, at + 11) / kPerMetre;
  laser.horiz_offset_m = signed16(bytes, at + 13) / kPerMetre;
  laser.focal_distance_m = signed16(bytes, at + 15) / kPerMetre;
  laser.focal_slope = signed16(bytes, at + 17) / kPerSlope;
  laser.min_intensity = bytes[at + 19];
  laser.max_intensity = bytes[at + 20];
  laser.two_point = two_point_present(laser.dist_correction_m, laser.dist_correction_x_m,
                                      laser.dist_correction_y_m);
  return laser;
}

tl::unexpected<Error> malformed(std::string_view what) {
  return fail(ErrorCode::kMalformed, fmt::format("calibration in the packet stream: {}", what));
}

/// Writes numbers in stream units and remembers the first that does not fit.
class TableWriter {
 public:
  explicit TableWriter(std::array<std::uint8_t, kStreamTableBytes>& bytes) : bytes_(bytes) {}

  void put8(std::size_t at, int value, std::string_view field) {
    require(value >= 0 && value <= 0xFF, field, value);
    bytes_[at] = static_cast<std::uint8_t>(value & 0xFF);
  }
  void put_u16(std::size_t at, int value, std::string_view field) {
    require(value >= 0 && value <= 0xFFFF, field, value);
    store(at, static_cast<unsigned>(value));
  }
  void put_i16(std::size_t at, int value, std::string_view field) {
    require(value >= -0x8000 && value <= 0x7FFF, field, value);
    store(at, static_cast<unsigned>(value));
  }
  void put_rounded(std::size_t at, double value, double counts_per_unit, std::string_view field) {
    const double counts = std::round(value * counts_per_unit);
    require(std::abs(counts) <= 0x7FFF, field, value);
    store(at, static_cast<unsigned>(std::abs(counts) <= 0x7FFF ? static_cast<int>(counts) : 0));
  }
  const std::string& problem() const { return problem_; }

 private:
  void require(bool fits, std::string_view field, double value) {
    if (!fits && problem_.empty()) {
      problem_ =
          fmt::format("{} is {:g}, which does not fit in its field of the stream", field, value);
    }
  }
  void store(std::size_t at, unsigned value) {
    bytes_[at] = static_cast<std::uint8_t>(value & 0xFFU);
    bytes_[at + 1] = static_cast<std::uint8_t>((value >> 8) & 0xFFU);
  }

  std::array<std::uint8_t, kStreamTableBytes>& bytes_;
  std::string problem_;
};

void put_laser(TableWriter& table, std::size_t number, const Hdl64eLaser& laser) {
  const std::size_t at = laser_at(number);
  const double far_m = laser.dist_correction_m;
  table.put8(at, static_cast<int>(number), "laser number");
  table.put_rounded(at + 1, beams::rad_to_deg(laser.vert_correction_rad), kPerDegree,
                    "vertical correction");
  table.put_rounded(at + 3, beams::rad_to_deg(laser.rot_correction_rad), kPerDegree,
                    "rotational correction");
  table.put_rounded(at + 5, far_m, kPerMetre, "distance correction");
  table.put_rounded(at + 7, laser.two_point ? laser.dist_correction_x_m : far_m, kPerMetre,
                    "distance correction X");
  table.put_rounded(at + 9, laser.two_point ? laser.dist_correction_y_m : far_m, kPerMetre,
                    "distance correction Y");
  table.put_rounded(at + 11, laser.vert_offset_m, kPerMetre, "vertical offset");
  table.put_rounded(at + 13, laser.horiz_offset_m, kPerMetre, "horizontal offset");
  table.put_rounded(at + 15, laser.focal_distance_m, kPerMetre, "focal distance");
  table.put_rounded(at + 17, laser.focal_slope, kPerSlope, "focal slope");
  table.put8(at + 19, laser.min_intensity, "minimum intensity");
  table.put8(at + 20, laser.max_intensity, "maximum intensity");
}

void put_date(TableWriter& table, const std::optional<UnitInfo::CalibrationDate>& date) {
  const UnitInfo::CalibrationDate unset{2255, 255, 255, 255, 255, 255};
  const UnitInfo::CalibrationDate& d = date ? *date : unset;
  table.put8(kDate, d.year - 2000, "calibration year");
  table.put8(kDate + 1, d.month, "calibration month");
  table.put8(kDate + 2, d.day, "calibration day");
  table.put8(kDate + 3, d.hour, "calibration hour");
  table.put8(kDate + 4, d.minute, "calibration minute");
  table.put8(kDate + 5, d.second, "calibration second");
}

}  // namespace

std::uint16_t stream_table_crc(Bytes bytes) noexcept {
  unsigned crc = 0;
  for (std::size_t laser = 0; laser < kHdl64eLasers; ++laser) {
    for (const std::uint8_t byte : bytes.subspan(laser_at(laser) + 1, kCrcBytesPerLaser)) {
      crc ^= static_cast<unsigned>(byte) << 8;
      for (int bit = 0; bit < 8; ++bit) {
        crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x8005U : crc << 1;
      }
      crc &= 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

Expected<StreamTable> parse_stream_table(Bytes bytes) {
  if (!std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                  [](char c, std::uint8_t b) { return static_cast<std::uint8_t>(c) == b; })) {
    return malformed("it does not begin with \"UNIT#\"");
  }
  StreamTable table;
  const int check = unsigned16(bytes, kCheck);
  const int crc = stream_table_crc(bytes);
  if (check == crc) {
    table.check = StreamTableCheck::kCrc;
  } else if (check == static_cast<int>(kStreamTableBytes)) {
    table.check = StreamTableCheck::kLengthMarker;
  } else {
    return malformed(fmt::format(
        "expected CRC 0x{:04X} or the length 1820 at its end, found 0x{:04X}", crc, check));
  }
  table.calibration.origin = "packet stream";
  for (std::size_t i = 0; i < kHdl64eLasers; ++i) {
    const std::size_t at = laser_at(i);
    if (bytes[at] != i) {
      return malformed(fmt::format("laser number {} in the place of laser {}", bytes[at], i));
    }
    table.calibration.lasers[i] = laser_from(bytes, at);
  }
  if (const Status status = validate(table.calibration); !status) {
    return tl::unexpected(status.error());
  }
  table.unit = unit_from(bytes);
  return table;
}

Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, const UnitInfo& unit, StreamTableCheck check) {
  if (const Status status = validate(calibration); !status) {
    return fail(ErrorCode::kInvalidArgument, status.error().message);
  }
  std::array<std::uint8_t, kStreamTableBytes> bytes{};
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  TableWriter table(bytes);
  table.put8(5, unit.upper_noise_threshold, "upper noise threshold");
  table.put8(6, unit.lower_noise_threshold, "lower noise threshold");
  for (std::size_t i = 0; i < kHdl64eLasers; ++i) {
    put_laser(table, i, calibration.lasers[i]);
    if (i + 1 < kHdl64eLasers) bytes[laser_at(i) + kWarning] = unit.warning_bits;
  }
  put_date(table, unit.calibration_date);
  table.put8(kDate + 6, unit.humidity_percent, "humidity");
  table.put_i16(kMotor, unit.motor_rpm, "motor speed");
  table.put_u16(kMotor + 2, unit.fov_start_cdeg, "field of view start");
  table.put_u16(kMotor + 4, unit.fov_end_cdeg, "field of view end");
  table.put_u16(kMotor + 6, unit.hours_run, "hours run");
  std::copy(unit.source_ip.begin(), unit.source_ip.end(), bytes.begin() + kAddresses);
  std::copy(unit.destination_ip.begin(), unit.destination_ip.end(), bytes.begin() + kAddresses + 4);
  bytes[kReturnSetting] = unit.return_setting;
  bytes[kReturnSetting + 1] = unit.reserved_or_warning;
  bytes[kReturnSetting + 2] = unit.power_level;
  const int end = check == StreamTableCheck::kCrc ? stream_table_crc(bytes)
                                                  : static_cast<int>(kStreamTableBytes);
  table.put_u16(kCheck, end, "check");
  if (!table.problem().empty()) return fail(ErrorCode::kInvalidArgument, table.problem());
  return bytes;
}

}  // namespace terracut::hdl64e
