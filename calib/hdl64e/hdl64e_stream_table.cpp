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

// Byte offsets in the table (HDL-64E S3 manual Rev K, pp. 33-38).
constexpr std::string_view kMagic = "UNIT#";
constexpr std::size_t kFirstLaser = 7;
constexpr std::size_t kLaserStride = 28;       ///< 21 bytes of the laser and 7 others
constexpr std::size_t kCrcBytesPerLaser = 20;  ///< all bytes of a laser except its number
constexpr std::size_t kDate = 256 * 7, kDateBytes = 6;
constexpr std::size_t kReturnSetting = 259 * 7 + 2;
constexpr std::size_t kCheck = kStreamTableBytes - 2;

// Counts in the table per degree and per metre. Dividing by these gives the doubles nearest to the
// decimal values, as files do.
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

/// Writes words in the stream's units and remembers the first that does not fit.
class TableWriter {
 public:
  explicit TableWriter(std::array<std::uint8_t, kStreamTableBytes>& bytes) : bytes_(bytes) {}

  void put_u16(std::size_t at, unsigned value) {
    bytes_[at] = static_cast<std::uint8_t>(value & 0xFFU);
    bytes_[at + 1] = static_cast<std::uint8_t>((value >> 8) & 0xFFU);
  }
  void put_rounded(std::size_t at, double value, double counts_per_unit, std::string_view field) {
    const double counts = std::round(value * counts_per_unit);
    const bool fits = std::abs(counts) <= 0x7FFF;
    if (!fits && problem_.empty()) {
      problem_ =
          fmt::format("{} is {:g}, which does not fit in its field of the stream", field, value);
    }
    put_u16(at, static_cast<unsigned>(fits ? static_cast<int>(counts) : 0));
  }
  const std::string& problem() const { return problem_; }

 private:
  std::array<std::uint8_t, kStreamTableBytes>& bytes_;
  std::string problem_;
};

/// Writes those values of one laser that take two bytes; its one-byte values are written elsewhere.
void put_laser(TableWriter& table, std::size_t at, const Hdl64eLaser& laser) {
  const double far_m = laser.dist_correction_m;
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

Expected<Hdl64eCalibration> parse_stream_table(Bytes bytes) {
  if (!std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                  [](char c, std::uint8_t b) { return static_cast<std::uint8_t>(c) == b; })) {
    return malformed("it does not begin with \"UNIT#\"");
  }
  const int check = unsigned16(bytes, kCheck);
  const int crc = stream_table_crc(bytes);
  if (check != crc && check != static_cast<int>(kStreamTableBytes)) {
    return malformed(fmt::format(
        "expected CRC 0x{:04X} or the length 1820 at its end, found 0x{:04X}", crc, check));
  }
  Hdl64eCalibration calibration;
  calibration.origin = "packet stream";
  for (std::size_t i = 0; i < kHdl64eLasers; ++i) {
    const std::size_t at = laser_at(i);
    if (bytes[at] != i) {
      return malformed(fmt::format("laser number {} in the place of laser {}", bytes[at], i));
    }
    calibration.lasers[i] = laser_from(bytes, at);
  }
  if (const Status status = validate(calibration); !status) return tl::unexpected(status.error());
  return calibration;
}

Expected<std::array<std::uint8_t, kStreamTableBytes>> make_stream_table(
    const Hdl64eCalibration& calibration, ReturnSetting setting, StreamTableCheck check) {
  if (const Status status = validate(calibration); !status) {
    return fail(ErrorCode::kInvalidArgument, status.error().message);
  }
  std::array<std::uint8_t, kStreamTableBytes> bytes{};
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  TableWriter table(bytes);
  for (std::size_t i = 0; i < kHdl64eLasers; ++i) {
    const std::size_t at = laser_at(i);
    bytes[at] = static_cast<std::uint8_t>(i);
    put_laser(table, at, calibration.lasers[i]);
    bytes[at + 19] = static_cast<std::uint8_t>(calibration.lasers[i].min_intensity);
    bytes[at + 20] = static_cast<std::uint8_t>(calibration.lasers[i].max_intensity);
  }
  std::fill_n(bytes.begin() + kDate, kDateBytes, std::uint8_t{0xFF});  // no calibration date
  bytes[kReturnSetting] = static_cast<std::uint8_t>(setting);
  table.put_u16(kCheck, check == StreamTableCheck::kCrc ? stream_table_crc(bytes)
                                                        : unsigned{kStreamTableBytes});
  if (!table.problem().empty()) return fail(ErrorCode::kInvalidArgument, table.problem());
  return bytes;
}

}  // namespace terracut::hdl64e
