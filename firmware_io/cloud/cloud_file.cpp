// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "firmware_io/cloud/cloud_bytes.hpp"
#include "firmware_io/cloud/field_table.hpp"
#include "firmware_io/cloud/pcd_file.hpp"
#include "firmware_io/cloud/ply_file.hpp"
#include "rt/files/ending.hpp"
#include "rt/files/record_file.hpp"

namespace terracut::cloud {
namespace {

namespace fs = std::filesystem;

using Values = std::optional<std::span<const double>>;

/// True for a number in the range of laser numbers.
bool is_laser_number(double number) noexcept {
  return number >= 0 && number < kMostLasers && number == std::floor(number);
}

constexpr const char* kExpectedLaser = "expected a whole number from 0 to {}";

/// Examines a field of laser numbers. Ignores points without a valid position: drivers write any
/// number where a beam had no return.
struct LaserField {
  explicit LaserField(std::span<const scan::ScanPoint> points, std::span<const double> numbers) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!scan::is_place(points[i])) continue;
      if (!is_laser_number(numbers[i])) {
        wrong = i;
        return;
      }
      is_filled |= numbers[i] != 0;
    }
  }
  std::optional<std::size_t> wrong;  ///< The first point with a value that is no laser number.
  bool is_filled = false;            ///< True if some numbers are not 0.
};

/// Takes the laser numbers from the first field that has them. Some drivers do not know the numbers
/// and write zeros: such a field is taken only if no other field has numbers. A field with other
/// values holds no laser numbers; cloud.laser_note then says so.
void take_lasers(const FieldTable& table, Cloud& cloud) {
  Values chosen;
  std::string_view chosen_name;
  for (const std::string_view name : kLaserFields) {
    const Values numbers = table.field_like(name);
    if (!numbers) continue;
    const LaserField field(cloud.points, *numbers);
    if (field.wrong) {
      if (!cloud.laser_note.empty()) continue;
      cloud.laser_note =
          fmt::format("{} of point {} is {}, ", name, *field.wrong, (*numbers)[*field.wrong]) +
          fmt::format(kExpectedLaser, kMostLasers - 1);
      continue;
    }
    if (!chosen || field.is_filled) {
      chosen = numbers;
      chosen_name = name;
    }
    if (field.is_filled) break;
  }
  if (!chosen) {
    if (cloud.laser_note.empty()) {
      cloud.laser_note = quotable(fmt::format("its fields are {}", fmt::join(table.names, " ")));
    }
    return;
  }
  cloud.laser_note = fmt::format("field {}", chosen_name);
  cloud.laser.resize(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    const double number = (*chosen)[i];
    cloud.laser[i] = is_laser_number(number) ? static_cast<std::uint16_t>(number) : 0;
  }
}

/// Moves points from the file's frame to the sensor frame by the sensor's pose, which the file
/// states.
class ToSensor {
 public:
  explicit ToSensor(const std::array<double, 7>& viewpoint) : at_(viewpoint) {
    const double norm = std::hypot(std::hypot(at_[3], at_[4]), std::hypot(at_[5], at_[6]));
    for (std::size_t i = 3; i < at_.size(); ++i) at_[i] /= norm;
  }

  void move(double& x, double& y, double& z) const noexcept {
    const bool is_measured = (x != 0 || y != 0 || z != 0) && std::isfinite(x + y + z);
    if (!is_measured) return;
    const double w = at_[3], qx = -at_[4], qy = -at_[5], qz = -at_[6];  // the inverse rotation
    const double px = x - at_[0], py = y - at_[1], pz = z - at_[2];
    const double tx = 2 * (qy * pz - qz * py), ty = 2 * (qz * px - qx * pz),
                 tz = 2 * (qx * py - qy * px);
    x = px + w * tx + qy * tz - qz * ty;
    y = py + w * ty + qz * tx - qx * tz;
    z = pz + w * tz + qx * ty - qy * tx;
  }

 private:
  std::array<double, 7> at_;
};

Status take_table(const fs::path& path, const FieldTable& table, SensorPlace sensor, Cloud& cloud) {
  const Values x = table.field_like("x"), y = table.field_like("y"), z = table.field_like("z");
  if (!x || !y || !z) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: expected the fields x, y and z; it has: {}",
                                                   path.string(), fmt::join(table.names, " ")));
  }
  Values intensity;
  for (const std::string_view name : kIntensityFields) {
    if (!intensity) intensity = table.field_like(name);
  }
  scan::RemissionScale scale;
  for (std::size_t i = 0; intensity && i < table.points; ++i) {
    scale.add(static_cast<float>((*intensity)[i]));
  }
  const float factor = scale.factor();
  cloud.has_viewpoint = table.viewpoint.has_value();
  std::optional<ToSensor> to_sensor;
  if (sensor == SensorPlace::kViewpoint && table.viewpoint) to_sensor.emplace(*table.viewpoint);
  cloud.points.resize(table.points);
  for (std::size_t i = 0; i < table.points; ++i) {
    double at[] = {(*x)[i], (*y)[i], (*z)[i]};
    if (to_sensor) to_sensor->move(at[0], at[1], at[2]);
    cloud.points[i] = {static_cast<float>(at[0]), static_cast<float>(at[1]),
                       static_cast<float>(at[2]),
                       intensity ? static_cast<float>((*intensity)[i]) * factor : 0.0F};
  }
  cloud.rows = table.rows;
  take_lasers(table, cloud);
  return {};
}

Status read_table(const fs::path& path, const Expected<FieldTable>& table, SensorPlace sensor,
                  Cloud& cloud) {
  if (!table) return tl::unexpected(table.error());
  return take_table(path, *table, sensor, cloud);
}

Status read_by_name(const fs::path& path, SensorPlace sensor, Cloud& cloud) {
  const std::string ending = files::ending_of(path);
  if (ending == ".pcd") return read_table(path, read_pcd(path), sensor, cloud);
  if (ending == ".ply") return read_table(path, read_ply(path), sensor, cloud);
  if (ending != ".bin") {
    return fail(ErrorCode::kUnsupported,
                path.string() + ": expected a cloud: .bin, .pcd.bin, .pcd or .ply");
  }
  return files::ending_of(path.stem()) == ".pcd" ? read_nuscenes_bin(path, cloud)
                                                 : scan::read_kitti_points(path, cloud.points);
}

void clear(Cloud& cloud) {
  cloud.points.clear();
  cloud.laser.clear();
  cloud.rows = 1;
  cloud.laser_note.clear();
  cloud.has_viewpoint = false;
}

}  // namespace

bool is_cloud_file(const fs::path& path) {
  const std::string ending = files::ending_of(path);
  return ending == ".bin" || ending == ".pcd" || ending == ".ply";
}

Status read_nuscenes_bin(const fs::path& path, Cloud& cloud) {
  struct Record {
    float x_m, y_m, z_m, intensity, ring;
  };
  clear(cloud);
  std::vector<Record> records;
  Status read = files::read_records(
      path,
      {"point of 5 float32 (x y z intensity ring)", sizeof(Record), scan::kMaxScanPoints, true},
      records);
  cloud.points.resize(records.size());
  cloud.laser.resize(records.size());
  for (std::size_t i = 0; read && i < records.size(); ++i) {
    const Record& record = records[i];
    cloud.points[i] = {record.y_m, -record.x_m, record.z_m, record.intensity / 255};
    if (is_laser_number(record.ring)) {
      cloud.laser[i] = static_cast<std::uint16_t>(record.ring);
    } else if (scan::is_place(cloud.points[i])) {
      read = fail(ErrorCode::kMalformed,
                  fmt::format("{}: ring of point {} is {}; ", path.string(), i, record.ring) +
                      fmt::format(kExpectedLaser, kMostLasers - 1));
    }
  }
  std::error_code none;
  if (!read && fs::file_size(path, none) % sizeof(scan::ScanPoint) == 0 && !none) {
    read.error().message += "; are these 4 floats a point (x y z remission)? Then name it .bin";
  }
  return read;
}

Status read_cloud(const fs::path& path, Cloud& cloud, SensorPlace sensor) {
  clear(cloud);
  if (Status read = read_by_name(path, sensor, cloud); !read) return read;
  Status near = check_reach(cloud.points);
  if (!near) near.error().message.insert(0, path.string() + ": ");
  return near;
}

}  // namespace terracut::cloud
