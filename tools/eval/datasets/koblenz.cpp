// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "koblenz.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "firmware_io/scan/ring_table_fit.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "pcd_cloud.hpp"

namespace terracut::evaluation {

const std::string_view kKoblenzFormatNote =
    "the format in which these data were published could not be found; PCD files are read, see "
    "docs/evaluation.md, and labels are taken as 0 unknown, 1 street, 2 rough, 3 obstacle";

namespace {

namespace fs = std::filesystem;
using firmware_io::kNoRing;
using firmware_io::kScanRings;
using firmware_io::ScanPoint;

/// The ring that each laser's number stands for; kNoRing for lasers of which nothing is known.
using RingOfLaser = std::array<std::int16_t, static_cast<std::size_t>(kScanRings)>;

/// Points, labels and lasers of a file, before the lasers' order is known.
struct NumberedScan {
  firmware_io::KittiScan scan;
  std::vector<std::int16_t> laser_of_point;
};

/// A field of whole numbers in [0, most].
Expected<std::span<const double>> whole_numbers(const PcdCloud& cloud, const std::string& file,
                                                std::string_view name, double most) {
  const auto values = cloud.field(name);
  if (!values) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: there is no field '{}'; it has: {}", file,
                                                   name, fmt::join(cloud.fields(), " ")));
  }
  for (std::size_t i = 0; i < values->size(); ++i) {
    const double value = (*values)[i];
    if (!(value >= 0 && value <= most) || value != std::floor(value)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: {} of point {} is {}; expected a whole number from 0 to {}",
                              file, name, i, value, most));
    }
  }
  return *values;
}

Status read_numbered(const fs::path& path, NumberedScan& to) {
  const auto cloud = PcdCloud::read(path);
  if (!cloud) return tl::unexpected(cloud.error());
  const std::string file = path.string();
  const auto x = cloud->field("x"), y = cloud->field("y"), z = cloud->field("z");
  if (!x || !y || !z) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: expected the fields x, y and z; it has: {}",
                                                   file, fmt::join(cloud->fields(), " ")));
  }
  const bool by_ring = !cloud->field("laser") && cloud->field("ring");
  const auto laser = whole_numbers(*cloud, file, by_ring ? "ring" : "laser", kScanRings - 1);
  if (!laser) return tl::unexpected(laser.error());
  const auto label =
      whole_numbers(*cloud, file, "label", std::numeric_limits<std::uint16_t>::max());
  if (!label) return tl::unexpected(label.error());
  const auto intensity = cloud->field("intensity");

  const std::size_t points = cloud->points();
  to.scan.points.resize(points);
  to.scan.labels.resize(points);
  to.laser_of_point.resize(points);
  to.scan.no_place = 0;
  for (std::size_t i = 0; i < points; ++i) {
    ScanPoint& point = to.scan.points[i];
    point = {static_cast<float>((*x)[i]), static_cast<float>((*y)[i]), static_cast<float>((*z)[i]),
             intensity ? static_cast<float>((*intensity)[i] / 255) : 0.0F};
    to.scan.labels[i] = static_cast<std::uint32_t>((*label)[i]);
    to.laser_of_point[i] = static_cast<std::int16_t>((*laser)[i]);
    if (!is_place(point)) ++to.scan.no_place;
  }
  if (to.scan.no_place < points) return {};
  return fail(ErrorCode::kMalformed, file + ": no point is finite");
}

void find_rings(const NumberedScan& scan, const RingOfLaser& ring_of_laser,
                firmware_io::RingRecovery& rings) {
  std::array<bool, static_cast<std::size_t>(kScanRings)> met{};
  rings = {.ring_of_point = std::move(rings.ring_of_point)};
  rings.ring_of_point.resize(scan.scan.points.size());
  for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
    const auto laser = static_cast<std::size_t>(scan.laser_of_point[i]);
    const std::int16_t ring = is_place(scan.scan.points[i]) ? ring_of_laser[laser] : kNoRing;
    rings.ring_of_point[i] = ring;
    if (ring == kNoRing) {
      ++rings.no_ring;
    } else {
      met[laser] = true;
    }
  }
  rings.rings = static_cast<int>(std::ranges::count(met, true));
}

/// Elevations of what each laser measured, from which their order follows.
class LaserElevations {
 public:
  void add(const NumberedScan& scan) {
    for (std::size_t i = 0; i < scan.scan.points.size(); i += kEvery) {
      const ScanPoint& point = scan.scan.points[i];
      if (!is_place(point)) continue;
      const double distance_m = std::hypot(double{point.x_m}, double{point.y_m});
      samples_[static_cast<std::size_t>(scan.laser_of_point[i])].push_back(
          {distance_m, std::atan2(double{point.z_m}, distance_m)});
    }
  }

  /// The highest laser is ring 0; lasers without any point have no ring.
  [[nodiscard]] RingOfLaser order() {
    std::array<double, static_cast<std::size_t>(kScanRings)> elevation_rad{};
    std::vector<std::size_t> lasers;
    for (std::size_t laser = 0; laser < samples_.size(); ++laser) {
      if (samples_[laser].empty()) continue;
      elevation_rad[laser] = typical_elevation_rad(samples_[laser]);
      lasers.push_back(laser);
    }
    std::ranges::sort(lasers, [&](std::size_t a, std::size_t b) {
      return elevation_rad[a] != elevation_rad[b] ? elevation_rad[a] > elevation_rad[b] : a < b;
    });
    RingOfLaser ring_of_laser;
    ring_of_laser.fill(kNoRing);
    for (std::size_t ring = 0; ring < lasers.size(); ++ring) {
      ring_of_laser[lasers[ring]] = static_cast<std::int16_t>(ring);
    }
    return ring_of_laser;
  }

 private:
  struct Sample {
    double distance_m, elevation_rad;
  };
  static constexpr std::size_t kEvery = 7;  ///< No divisor of 64: firing order brings all lasers.

  /// The median over the farther half: lasers do not start at the origin, which matters least far
  /// away.
  [[nodiscard]] static double typical_elevation_rad(std::vector<Sample>& samples) {
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
    std::ranges::nth_element(samples, middle, {}, &Sample::distance_m);
    const auto far_middle = middle + (samples.end() - middle) / 2;
    std::ranges::nth_element(middle, far_middle, samples.end(), {}, &Sample::elevation_rad);
    return far_middle->elevation_rad;
  }

  std::array<std::vector<Sample>, static_cast<std::size_t>(kScanRings)> samples_;
};

class KoblenzSequence final : public Sequence {
 public:
  explicit KoblenzSequence(std::vector<fs::path> files) : files_(std::move(files)) {}

  std::size_t size() const override { return files_.size(); }
  std::string frame(std::size_t index) const override { return files_[index].stem().string(); }
  fs::path file(std::size_t index) const override { return files_[index]; }
  const calib::Hdl64eCalibration& calibration() const override { return calibration_; }

  Status read(std::size_t index, LabelledScan& scan) const override {
    NumberedScan numbered{std::move(scan.scan), {}};
    const Status status = read_numbered(files_[index], numbered);
    if (status) find_rings(numbered, ring_of_laser_, scan.rings);
    scan.scan = std::move(numbered.scan);
    return status;
  }

  Status learn_rings() {
    const std::size_t count = std::min(size(), firmware_io::ScanReader::kScansToFit);
    std::vector<std::size_t> used;
    Error last{ErrorCode::kMalformed, ""};
    LaserElevations elevations;
    NumberedScan scan;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = i * size() / count;
      // A file that cannot be read says so when its turn comes.
      if (const Status status = read_numbered(files_[index], scan); !status) {
        last = status.error();
        continue;
      }
      elevations.add(scan);
      used.push_back(index);
    }
    if (used.empty()) return tl::unexpected(std::move(last));
    ring_of_laser_ = elevations.order();

    firmware_io::RingTableFit fit;
    firmware_io::RingRecovery rings;
    for (const std::size_t index : used) {
      if (!read_numbered(files_[index], scan)) continue;
      find_rings(scan, ring_of_laser_, rings);
      fit.add(scan.scan.points, rings.ring_of_point);
    }
    const auto fitted = fit.fit();
    if (!fitted) return tl::unexpected(fitted.error());
    if (fitted->residual.p95_m > kWidestCone_m) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: the points of a laser do not lie on a cone around the origin "
                              "(5 % of them are off by more than {:.1f} m): expected are points "
                              "in the sensor's own frame, turn by turn, and the laser of each",
                              files_.front().parent_path().string(), fitted->residual.p95_m));
    }
    calibration_ = firmware_io::hdl64e_calibration(fitted->table);
    return {};
  }

 private:
  /// Far beyond noise and motion, far below what a map's frame or wrong numbers do.
  static constexpr double kWidestCone_m = 1.0;

  std::vector<fs::path> files_;
  RingOfLaser ring_of_laser_{};
  calib::Hdl64eCalibration calibration_;
};

std::vector<fs::path> clouds_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

Expected<std::vector<std::string>> Koblenz::sequences() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root_, error)) {
    if (!clouds_in(entry.path()).empty()) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  if (!names.empty()) return names;
  return fail(ErrorCode::kNotFound,
              fmt::format("expected folders like {}/KoblenzForestMap with .pcd files (fields x y z "
                          "laser label), found none; {}",
                          root_.string(), kKoblenzFormatNote));
}

Expected<std::unique_ptr<Sequence>> Koblenz::open(const std::string& sequence) const {
  auto files = clouds_in(folder(sequence));
  if (files.empty()) {
    return fail(ErrorCode::kNotFound, folder(sequence).string() + ": no .pcd file in it");
  }
  auto opened = std::make_unique<KoblenzSequence>(std::move(files));
  if (const Status learned = opened->learn_rings(); !learned) {
    return tl::unexpected(learned.error());
  }
  return opened;
}

}  // namespace terracut::evaluation
