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

/// The method's parameters by name; docs/reference/method.md has their effect.
enum class Profile : std::uint8_t {
  kTerracut,  ///< The default.
  kPaper,     ///< The published method, as it was published.
};

/// One revolution of a spinning LiDAR with 8 to 256 lasers, its points in any order.
struct Cloud {
  std::span<const CloudPoint> points;
  /// Which laser measured each point, in any numbering from 0 to 255; empty where that is not
  /// known.
  std::span<const std::uint16_t> laser = {};
  /// Of an organised cloud, whose points stand row after row, as many in each; 1: not organised.
  std::size_t rows = 1;
};

/// What a field of a point is made of; the numbers are those of sensor_msgs/PointField.
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

/// A field of a point.
struct PointField {
  std::string_view name;
  std::size_t offset = 0;  ///< From the point's beginning, bytes.
  FieldType type = FieldType::kFloat32;
  std::size_t count = 1;  ///< Values of it, next to each other; 0 counts as 1.
};

/// A cloud as drivers hand it out, and as sensor_msgs/PointCloud2 has it: points with named fields.
/// Looked for are x, y, z (metres); the laser in ring, channel, laser or row; and intensity, which
/// pictures alone need. So PointXYZIRC, PointXYZIRCAEDT, PointXYZIRT, Ouster's and others' layouts
/// serve as they are; azimuth, time and whatever else they hold is not needed.
struct PointBuffer {
  std::span<const std::byte> data;
  std::span<const PointField> fields;
  std::size_t point_step = 0;  ///< From one point to the next, bytes.
  std::size_t width = 0;       ///< Points of a row.
  std::size_t height = 1;      ///< Rows; above 1 the cloud is organised.
  std::size_t row_step = 0;    ///< From one row to the next, bytes; 0: width * point_step.
  bool big_endian = false;     ///< Of every value.
};

/// Labels clouds of one sensor. What tells the laser of a point is, in this order: its number; the
/// rows of an organised cloud (its columns, where these are fewer); the order of KITTI's .bin
/// files, 64 rings from the top, each counter-clockwise from straight ahead; the elevations of the
/// points.
///
/// The first cloud decides which of them it is, which elevation each laser has and how often it
/// fires in a revolution. It allocates and takes some 100 ms; later ones do not, unless they are in
/// KITTI's order with rings missing. One thread; not for threads with a deadline.
class Segmenter {
 public:
  struct Config {
    Mount mount{};
    Profile profile = Profile::kTerracut;
    /// The near ground of the first clouds says how the sensor stands, x ahead, instead of `mount`:
    /// the first that shows it, and from the tenth on that of all ten, which allocates, too. Until
    /// then label() fails with kMountNotFound: a vehicle that stands where no ground is seen 3 to
    /// 15 m before or behind it shows nothing.
    bool find_mount = false;
    /// With find_mount: labels by `mount` as long as no cloud shows it, instead of failing;
    /// meanwhile found_mount() is empty.
    bool guess_mount = false;
    /// Parameters of the method that differ from the profile's, "KEY=VALUE";
    /// docs/reference/parameters.md lists them.
    std::vector<std::string> parameters = {};
  };

  /// kInvalidArgument on a mount out of range, and on a parameter that is none or out of its range.
  [[nodiscard]] static Expected<Segmenter> make(const Config& config);
  Segmenter(Segmenter&&) noexcept;
  Segmenter& operator=(Segmenter&&) noexcept;
  ~Segmenter();

  /// One label a point, in the cloud's order, valid until the next call; kNone for points that are
  /// no return (not finite, null, beyond 10 km); kObstacle, the safe side, for those of a laser
  /// that the first cloud had nothing of. Errors leave the segmenter as it was: kMountNotFound with
  /// Config::find_mount, where the next cloud may show it; kUnsupported or
  /// kMalformed where nothing tells the lasers apart, or not what told them in the first cloud;
  /// kCapacityExceeded for a cloud of more than twice the first one's points and of more than two
  /// for each direction of each laser.
  [[nodiscard]] Expected<std::span<const Label>> label(const Cloud& cloud);
  [[nodiscard]] Expected<std::span<const Label>> label(std::span<const CloudPoint> points) {
    return label(Cloud{points});
  }
  /// The same of points as they lie in a driver's memory. kMalformed also for a missing x, y or z,
  /// or data too short for what is said of them.
  [[nodiscard]] Expected<std::span<const Label>> label(const PointBuffer& buffer);

  /// The mount that the last labels were made by, where it was found; none without
  /// Config::find_mount.
  [[nodiscard]] std::optional<FoundMount> found_mount() const noexcept;

 private:
  struct Engine;
  explicit Segmenter(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
