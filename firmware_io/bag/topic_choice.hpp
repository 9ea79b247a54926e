// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware_io/bag/bag.hpp"
#include "rt/error.hpp"

namespace terracut::bag {

/// True for clouds, sensor_msgs' PointCloud2.
[[nodiscard]] bool holds_clouds(std::string_view type) noexcept;

enum class Content : std::uint8_t { kPackets, kClouds, kEither };

/// Returns the index of the topic to read: the one named `wanted`, or, if that is empty, the only
/// one with such content. Ouster's packets of its inertial sensor (/.../imu_packets) are no
/// content. Fails with kInvalidArgument if the topic named is not there or of another type, or if
/// several could be meant, kUnsupported if none; the message lists the topics that could be named.
[[nodiscard]] Expected<std::size_t> choose_topic(const Bag& bag, std::string_view wanted,
                                                 Content content);

}  // namespace terracut::bag
