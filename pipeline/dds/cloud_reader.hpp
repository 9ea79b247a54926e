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

namespace terracut::dds {

/// A PointCloud2 that lies where Cyclone put it. It may be given back on any thread, while its
/// reader lives.
using TakenCloud = std::unique_ptr<const sensor_msgs_msg_dds__PointCloud2_,
                                   std::function<void(const sensor_msgs_msg_dds__PointCloud2_*)>>;

/// Takes clouds of one topic. One thread.
class CloudReader {
 public:
  /// `topic`: of dds_topic(). `reliable`: lost parts are asked for again, and writers that do not
  /// offer that are not heard.
  [[nodiscard]] static Expected<CloudReader> open(const Participant& participant,
                                                  const std::string& topic, bool reliable);

  /// Waits for a cloud, or until the time is up.
  void wait(std::int64_t timeout_ns);
  /// The oldest cloud that has not been taken; null where there is none.
  [[nodiscard]] TakenCloud take();
  /// Clouds that a writer sent and that did not come, as far as that is known.
  [[nodiscard]] std::uint64_t lost() const;
  /// How many writers there are now.
  [[nodiscard]] std::uint32_t writers() const;

 private:
  CloudReader(Entity topic, Entity reader, Entity waiting) noexcept
      : topic_(std::move(topic)), reader_(std::move(reader)), waiting_(std::move(waiting)) {}

  Entity topic_;
  Entity reader_;   ///< After its topic, so that it goes before it.
  Entity waiting_;  ///< For a cloud of the reader.
};

}  // namespace terracut::dds
