// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "participant.hpp"
#include "ros_types.h"
#include "rt/error.hpp"
#include "topic_reader.hpp"

namespace terracut::dds {

/// A PointCloud2 in Cyclone's own memory. Any thread may release the cloud while its reader lives.
using TakenCloud = std::unique_ptr<const sensor_msgs_msg_dds__PointCloud2_,
                                   std::function<void(const sensor_msgs_msg_dds__PointCloud2_*)>>;

/// Takes the clouds of one topic. For use by one thread.
class CloudReader {
 public:
  /// `topic` is from dds_topic(). With `reliable`, lost parts are requested again, but only from
  /// writers that offer this; others are not received at all.
  [[nodiscard]] static Expected<CloudReader> open(const Participant& participant,
                                                  const std::string& topic, bool reliable);

  /// Waits until a cloud arrives or the timeout ends.
  void wait(std::int64_t timeout_ns);
  /// Returns the oldest cloud not taken yet; null if there is none.
  [[nodiscard]] TakenCloud take();
  /// Returns how many clouds were sent but lost on the way, as far as Cyclone knows.
  [[nodiscard]] std::uint64_t lost() const;
  /// Returns the current number of writers of the topic.
  [[nodiscard]] std::uint32_t writers() const;

 private:
  CloudReader(TopicReader reader, Entity waiting) noexcept
      : reader_(std::move(reader)), waiting_(std::move(waiting)) {}

  TopicReader reader_;
  Entity waiting_;  ///< Wakes wait() when the reader has a cloud.
};

}  // namespace terracut::dds
