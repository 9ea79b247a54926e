// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bag_pose.hpp"
#include "firmware_io/bag/bag.hpp"
#include "firmware_io/cloud/cloud.hpp"
#include "pipeline/ros_messages/cloud_message.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The clouds of one topic of a bag, in the order of recording.
class BagClouds {
 public:
  /// Finds where the clouds are, for which it reads the whole bag. An empty `topic` takes the only
  /// one with clouds. A bag that breaks off has the clouds before that, which is warned of. Fails
  /// with the errors of bag::Bag::open() and bag::choose_topic(), or kNothingCameOut.
  [[nodiscard]] static Expected<BagClouds> open(const std::filesystem::path& path,
                                                std::string_view topic);

  [[nodiscard]] std::size_t size() const noexcept { return positions_.size(); }
  /// Returns what a cloud is called in messages.
  [[nodiscard]] std::string place(std::size_t index) const;
  /// Says how the sensor stands; clouds in the vehicle's frame are moved to the sensor's.
  [[nodiscard]] const BagPose& pose() const noexcept { return pose_; }

  /// Reads a cloud, with the checks of terracut::unpack() and cloud::check_reach().
  [[nodiscard]] Status read(std::size_t index, cloud::Cloud& cloud);
  /// Returns the header's stamp of the cloud read last, nanoseconds since 1970.
  [[nodiscard]] std::int64_t stamp_ns() const noexcept { return stamp_ns_; }

 private:
  BagClouds(bag::Bag bag, std::size_t topic);

  bag::Bag bag_;
  std::size_t topic_;
  std::vector<bool> wanted_;
  BagPose pose_;
  std::vector<bag::Bag::Position> positions_;
  std::int64_t stamp_ns_ = 0;
};

}  // namespace terracut::cli
