// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terracut/calibration.hpp"
#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// A named set of the method's parameters; docs/reference/method.md describes its effect.
enum class Profile : std::uint8_t {
  kTerracut,  ///< The method with terracut's improvements, the default.
  kPaper,     ///< The method as published.
};

/// One revolution of a spinning LiDAR with 8 to 256 lasers; points may be in any order.
struct Cloud {
  std::span<const CloudPoint> points;
  /// The laser number of each point, in any numbering from 0 to 255; empty if unknown.
  std::span<const std::uint16_t> laser = {};
  /// The number of rows of an organised cloud, which are of equal length; 1 if not organised.
  std::size_t rows = 1;
};

/// The type of a point's field, with the numbers of sensor_msgs/PointField.
enum class FieldType : std::uint8_t {
  kInt8 = 1,
  kUint8 = 2,
  kInt16 = 3,
  kUint16 = 4,
  kInt32 = 5,
  kUint32 = 6,
  kFloat32 = 7,
  kFloat64 = 8,
};

/// Describes one field of a point.
struct PointField {
  std::string_view name;
  std::size_t offset = 0;  ///< Offset in the point, bytes.
  FieldType type = FieldType::kFloat32;
  std::size_t count = 1;  ///< Number of adjacent values; 0 counts as 1.
};

/// A cloud in a driver's memory, in the terms of sensor_msgs/PointCloud2: points with named fields.
/// Used are x, y, z (metres), the laser number in ring, channel, laser or row, and intensity, only
/// for pictures. So layouts such as PointXYZIRC, PointXYZIRCAEDT, PointXYZIRT and Ouster's work as
/// they are; azimuth, time and other fields are ignored.
struct PointBuffer {
  std::span<const std::byte> data;
  std::span<const PointField> fields;
  std::size_t point_step = 0;  ///< Bytes from one point to the next.
  std::size_t width = 0;       ///< Points per row.
  std::size_t height = 1;      ///< Rows; above 1 the cloud is organised.
  std::size_t row_step = 0;    ///< Bytes from one row to the next; 0: width * point_step.
  bool big_endian = false;     ///< True if values are big-endian.
};

/// Labels clouds of one sensor. The laser of a point is found in the first of these ways that
/// works: the point's laser number; the rows of an organised cloud (or its columns, if fewer); the
/// order of KITTI's .bin files, 64 rings from the top, each counter-clockwise from straight ahead;
/// the elevations of the points.
///
/// The first cloud decides which way is used, the elevation of each laser and the firings in a
/// revolution. The first label() allocates and takes some 100 ms; later ones do not, unless clouds
/// in KITTI's order lack rings. For one thread without a deadline.
class Segmenter {
 public:
  struct Config {
    Mount mount{};
    Profile profile = Profile::kTerracut;
    /// Finds the mount from the near ground of the first clouds, x ahead, instead of using `mount`:
    /// from the first cloud that shows the mount or, from the tenth cloud on, from ten clouds
    /// together, which allocates. Until it is found, label() fails with kMountNotFound, for example
    /// if no ground is seen 3 to 30 m before or behind the vehicle.
    bool find_mount = false;
    /// With find_mount: as long as no cloud shows the mount, labels by `mount` instead of failing;
    /// found_mount() is then empty.
    bool guess_mount = false;
    /// Parameters of the method that differ from the profile's, "KEY=VALUE";
    /// docs/reference/parameters.md lists them.
    std::vector<std::string> parameters = {};
    bool heights = false;   ///< Provides height_above_ground_m().
    bool objects = false;   ///< Provides objects(), and height_above_ground_m().
    bool free_way = false;  ///< Provides free_way(), and height_above_ground_m().
  };

  /// Fails with kInvalidArgument if the mount or a parameter is out of range or unknown.
  [[nodiscard]] static Expected<Segmenter> make(const Config& config);
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;
  ~Segmenter();

  /// Returns one label per point, in the cloud's order, valid until the next call. Points that are
  /// no return (not finite, null, beyond 10 km) get kNone; points of a laser that the first cloud
  /// did not have get kObstacle, for safety. Errors leave the segmenter unchanged: kMountNotFound
  /// with Config::find_mount (the next cloud may show the mount); kUnsupported or kMalformed if
  /// nothing tells the lasers apart, or not as in the first cloud; kCapacityExceeded for a cloud of
  /// more than twice the first cloud's points and more than two per direction of each laser.
  [[nodiscard]] Expected<std::span<const Label>> label(const Cloud& cloud);
  [[nodiscard]] Expected<std::span<const Label>> label(std::span<const CloudPoint> points) {
    return label(Cloud{points});
  }
  /// Labels points in a driver's memory. Also fails with kMalformed if x, y or z is missing or
  /// there is less data than the sizes state.
  [[nodiscard]] Expected<std::span<const Label>> label(const PointBuffer& buffer);

  /// Returns the height of each point labelled last above the ground found below it, metres, in the
  /// cloud's order; NaN for points that are no return and for those of a laser that the first cloud
  /// did not have. Valid until the next label(); empty without Config::heights.
  [[nodiscard]] std::span<const float> height_above_ground_m() const noexcept;

  /// Returns the objects of the cloud labelled last, in the vehicle frame (calibration.hpp). Valid
  /// until the next label(); empty without Config::objects.
  [[nodiscard]] std::span<const Object> objects() const noexcept;
  /// Returns the number of the object of each point labelled last, in the cloud's order; 0: none;
  /// object i has the number i + 1. Valid and empty like objects().
  [[nodiscard]] std::span<const std::uint16_t> object_of_point() const noexcept;
  /// Returns the free way of the cloud labelled last by direction, clockwise; the first sector
  /// begins straight ahead. Clouds must be as the sensor measured them: in deskewed ones, points of
  /// a direction lie in other directions. Valid until the next label(); empty without
  /// Config::free_way.
  [[nodiscard]] std::span<const FreeWaySector> free_way() const noexcept;

  /// Returns the mount used for the last labels, if it was found; empty without Config::find_mount.
  [[nodiscard]] std::optional<FoundMount> found_mount() const noexcept;

 private:
  struct Engine;
  explicit Segmenter(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
