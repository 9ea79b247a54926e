// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "calib/beams/angle.hpp"
#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/mount/mount_pose.hpp"
#include "firmware_io/bag/bag.hpp"
#include "firmware_io/bag/topic_choice.hpp"
#include "firmware_io/cloud/elevation_bins.hpp"
#include "firmware_io/cloud/row_doubt.hpp"
#include "firmware_io/cloud/sensor_pose.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

Expected<cloud::SensorRows> learn_rows(CloudReader& clouds) {
  const cloud::ReadCloud read = [&](std::size_t index) { return clouds.read(index); };
  const auto learn = [&] { return cloud::learn_rows(clouds.size(), read); };
  const auto is_beyond_doubt = [](const Expected<cloud::SensorRows>& rows) {
    return rows && cloud::doubt_of(*rows).empty();
  };
  auto rows = learn();
  if (is_beyond_doubt(rows)) return rows;
  if (clouds.has_viewpoint()) {
    clouds.take_sensor_at(cloud::SensorPlace::kViewpoint);
    if (auto by_viewpoint = learn(); is_beyond_doubt(by_viewpoint)) {
      say("sensor: stood at each file's VIEWPOINT, not at the origin of the points, which are "
          "taken from there");
      return by_viewpoint;
    }
    clouds.take_sensor_at(cloud::SensorPlace::kOrigin);
  }
  const auto pose = cloud::find_sensor_pose(clouds.size(), read);
  if (!pose) return cloud::rows_or_bins(std::move(rows), clouds.size(), read);
  clouds.take_sensor_at(*pose);
  // If points lie farther than this from the cones, the cloud may be of two sensors, and only one
  // has these cones.
  constexpr double kOfOneSensor_m = 0.4;
  if (auto by_pose = learn();
      is_beyond_doubt(by_pose) && by_pose->rings.residual.p95_m < kOfOneSensor_m) {
    const auto& T = *pose;
    say(
        fmt::format("sensor: stood {:.2f} {:.2f} {:.2f} m from the origin of the points, its axis "
                    "{:.1f} degrees from theirs, by the cones of its lasers; points and mount are "
                    "taken in its own frame",
                    T[3], T[7], T[11], beams::rad_to_deg(std::acos(std::min(T[10], 1.0)))));
    return by_pose;
  }
  clouds.take_sensor_at(cloud::SensorPlace::kOrigin);
  return cloud::rows_or_bins(std::move(rows), clouds.size(), read);
}

}  // namespace

Expected<CloudReader> CloudReader::open(const std::filesystem::path& clouds,
                                        std::string_view topic) {
  if (bag::is_bag(clouds)) {
    auto bag = BagClouds::open(clouds, topic);
    if (!bag) return tl::unexpected(bag.error());
    return CloudReader(clouds, {}, *std::move(bag));
  }
  auto folder = scan::list_scan_folder(clouds, cloud::kCloudFiles);
  if (!folder) return tl::unexpected(folder.error());
  return CloudReader(clouds, std::move(folder->scans), {});
}

std::string CloudReader::place(std::size_t index) const {
  return bag_ ? bag_->place(index) : files_[index].points.string();
}

std::string CloudReader::name(std::size_t index) const {
  return bag_ ? fmt::format("{:06}", index) : files_[index].name;
}

std::uint32_t CloudReader::number(std::size_t index) const {
  const auto by_index = static_cast<std::uint32_t>(index);
  return bag_ ? by_index : files_[index].frame.value_or(by_index);
}

std::optional<std::int64_t> CloudReader::stamp_ns() const {
  return bag_ ? std::optional(bag_->stamp_ns()) : std::nullopt;
}

MountOptions CloudReader::stated(const MountOptions& mount) const {
  return bag_ ? stated_or_of_bag(mount, bag_->pose()) : mount;
}

void CloudReader::take_sensor_at(cloud::SensorPlace place) {
  place_ = place;
  to_sensor_.reset();
}

void CloudReader::take_sensor_at(const mount::RigidTransform& T_points_sensor) {
  to_sensor_ = mount::inverse(T_points_sensor);
}

Expected<cloud::CloudView> CloudReader::read(std::size_t index) {
  const Status read =
      bag_ ? bag_->read(index, cloud_) : cloud::read_cloud(files_[index].points, cloud_, place_);
  has_viewpoint_ = has_viewpoint_ || cloud_.has_viewpoint;
  if (!read) return tl::unexpected(read.error());
  if (to_sensor_) cloud::move_points(*to_sensor_, cloud_.points);
  return cloud_.view();
}

bool CloudReader::has_labels() const {
  return std::ranges::any_of(files_, [](const auto& file) { return file.labels.has_value(); });
}

Status CloudReader::read_labels(std::size_t index, std::size_t points,
                                std::vector<std::uint32_t>& labels) const {
  labels.clear();
  if (bag_ || !files_[index].labels) return {};
  return scan::read_label_file(*files_[index].labels, points, labels);
}

Expected<bool> holds_clouds(const CaptureOptions& options) {
  std::error_code none;
  if (!bag::is_bag(options.file)) {
    return std::filesystem::is_directory(options.file, none) || cloud::is_cloud_file(options.file);
  }
  const auto bag = bag::Bag::open(options.file);
  if (!bag) return tl::unexpected(bag.error());
  const auto topic = bag::choose_topic(*bag, options.topic, bag::Content::kEither);
  if (!topic) return tl::unexpected(topic.error());
  return bag::holds_clouds(bag->topics()[*topic].type);
}

Expected<cloud::SensorRows> rows_of(CloudReader& clouds, const std::filesystem::path& calibration) {
  if (!calibration.empty()) {
    const auto of_unit = hdl64e::load_hdl64e_calibration(calibration);
    if (!of_unit) return tl::unexpected(of_unit.error());
    return cloud::SensorRows{cloud::RowSource::kKittiOrder,
                             {scan::ring_table(*of_unit), {}, {}, false},
                             {},
                             frame::ImageShape{}.columns};
  }
  auto rows = learn_rows(clouds);
  if (!rows) {
    Error error = rows.error();
    const std::string input = clouds.input().string();
    if (!error.message.starts_with(input)) error.message.insert(0, input + ": ");
    return tl::unexpected(std::move(error));
  }
  const scan::RingTable& table = rows->rings.table;
  say(fmt::format("sensor: {} rows from {:.1f} to {:.1f} degrees, {} columns, by {}", table.size(),
                  beams::rad_to_deg(table.back().elevation_rad),
                  beams::rad_to_deg(table.front().elevation_rad), rows->columns,
                  description_of(rows->source)));
  if (rows->source == cloud::RowSource::kElevationBins) {
    say("        no lasers show: " + rows->no_lasers);
    if (rows->viewpoint_above_m != 0) {
      say(fmt::format(
          "        the origin of the points lies on the ground; they are seen from {:.2f} m "
          "above it, and so is the mount",
          rows->viewpoint_above_m));
    }
  }
  if (rows->rings.residual.points > 0) {
    say(fmt::format("        points lie within {:.1f} cm of their row's line (95 %)",
                    100 * rows->rings.residual.p95_m));
  }
  if (rows->rings.from_nominal_table) {
    say("        no scan has all rows, so they were told apart by a nominal HDL-64E's table; "
        "--calibration takes the unit's own");
  }
  if (const std::string doubt = cloud::doubt_of(*rows); !doubt.empty()) {
    warn(clouds.input().string() + ": " + doubt);
  }
  return rows;
}

}  // namespace terracut::cli
