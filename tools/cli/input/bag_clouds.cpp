// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "bag_clouds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "calib/mount/mount_pose.hpp"
#include "firmware_io/bag/topic_choice.hpp"
#include "firmware_io/cloud/cloud_bytes.hpp"
#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/cloud/sensor_pose.hpp"
#include "pipeline/api/point_buffer.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

std::string note_of_lasers(const PointBuffer& buffer, bool has_lasers) {
  if (has_lasers) return "their field of laser numbers";
  std::vector<std::string_view> names;
  for (const PointField& field : buffer.fields) names.push_back(field.name);
  return cloud::quotable(fmt::format("its fields are {}", fmt::join(names, " ")));
}

}  // namespace

BagClouds::BagClouds(bag::Bag bag, std::size_t topic)
    : bag_(std::move(bag)), topic_(topic), wanted_(bag_.topics().size()) {
  wanted_[topic] = true;
}

Expected<BagClouds> BagClouds::open(const std::filesystem::path& path, std::string_view topic) {
  auto bag = bag::Bag::open(path);
  if (!bag) return tl::unexpected(bag.error());
  const auto chosen = bag::choose_topic(*bag, topic, bag::Content::kClouds);
  if (!chosen) return tl::unexpected(chosen.error());
  BagClouds clouds(*std::move(bag), *chosen);
  clouds.pose_ = pose_in(clouds.bag_, *chosen);
  for (;;) {
    if (const Status going = go_on(); !going) return tl::unexpected(going.error());
    const auto found = clouds.bag_.next(clouds.wanted_);
    if (!found && clouds.size() == 0) return tl::unexpected(found.error());
    if (!found) warn(found.error().message);
    if (!found || !*found) break;
    clouds.positions_.push_back((*found)->position);
  }
  if (clouds.size() > 0) return clouds;
  return fail(ErrorCode::kNothingCameOut,
              fmt::format("{}: no cloud in {}", path.string(), clouds.bag_.topics()[*chosen].name));
}

std::string BagClouds::place(std::size_t index) const {
  return fmt::format("{}: cloud {} of {}", bag_.name(), index, bag_.topics()[topic_].name);
}

Status BagClouds::read(std::size_t index, cloud::Cloud& cloud) {
  const auto refused = [&](Error error) {
    return fail(error.code, fmt::format("{}: {}", place(index), error.message));
  };
  if (Status at = bag_.seek(positions_[index]); !at) return at;
  const auto found = bag_.next(wanted_);
  if (!found) return tl::unexpected(found.error());
  ros_messages::CloudMessage message;
  if (!*found || !message.read((*found)->message.bytes)) {
    return refused({ErrorCode::kMalformed, "is no PointCloud2"});
  }
  stamp_ns_ = std::max<std::int64_t>(0, message.header.stamp_ns);
  if (message.buffer.width == 0 || message.buffer.height == 0) {
    cloud.points.clear();
    cloud.laser.clear();
    return {};
  }
  if (auto unpacked = unpack(message.buffer, cloud); !unpacked) {
    return refused({ErrorCode::kMalformed, std::move(unpacked.error().message)});
  }
  cloud.laser_note = note_of_lasers(message.buffer, !cloud.laser.empty());
  if (const Status near = cloud::check_reach(cloud.points); !near) return refused(near.error());
  if (pose_.T_points_sensor) {
    cloud::move_points(mount::inverse(*pose_.T_points_sensor), cloud.points);
  }
  return {};
}

}  // namespace terracut::cli
