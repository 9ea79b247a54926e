// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cloud_reader.hpp"

#include <array>

namespace terracut::dds {
namespace {

/// The number of clouds kept for the taking thread; fewer arrive while it does not run.
constexpr int kKeptClouds = 16;

}  // namespace

Expected<CloudReader> CloudReader::open(const Participant& participant, const std::string& topic,
                                        bool reliable) {
  auto reader = TopicReader::open(participant, topic, kPointCloud2,
                                  {.reliable = reliable, .depth = kKeptClouds});
  if (!reader) return tl::unexpected(reader.error());
  // The condition belongs to the reader and is deleted with it.
  const dds_entity_t has_clouds = dds_create_readcondition(reader->id(), DDS_ANY_STATE);
  Entity waiting(dds_create_waitset(participant.id()));
  if (const dds_return_t added = dds_waitset_attach(waiting.id(), has_clouds, 0); added < 0) {
    return refused(ErrorCode::kInvalidArgument, "waiting for " + topic, added);
  }
  return CloudReader(*std::move(reader), std::move(waiting));
}

void CloudReader::wait(std::int64_t timeout_ns) {
  (void)dds_waitset_wait(waiting_.id(), nullptr, 0, timeout_ns);
}

TakenCloud CloudReader::take() {
  while (true) {
    std::array<void*, 1> taken{nullptr};
    std::array<dds_sample_info_t, 1> info{};
    if (dds_take(reader_.id(), taken.data(), info.data(), 1, 1) != 1) return {};
    TakenCloud cloud(static_cast<const sensor_msgs_msg_dds__PointCloud2_*>(taken[0]),
                     [reader = reader_.id()](const sensor_msgs_msg_dds__PointCloud2_* given) {
                       void* back = const_cast<sensor_msgs_msg_dds__PointCloud2_*>(given);
                       (void)dds_return_loan(reader, &back, 1);
                     });
    if (info[0].valid_data) return cloud;  // otherwise it only reports that a writer has gone
  }
}

std::uint64_t CloudReader::lost() const {
  dds_sample_lost_status_t lost{};
  if (dds_get_sample_lost_status(reader_.id(), &lost) < 0) return 0;
  return lost.total_count;
}

std::uint32_t CloudReader::writers() const {
  dds_subscription_matched_status_t matched{};
  if (dds_get_subscription_matched_status(reader_.id(), &matched) < 0) return 0;
  return matched.current_count;
}

}  // namespace terracut::dds
