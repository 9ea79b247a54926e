// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A program of somebody else's reads clouds by Cyclone DDS with ROS 2's SensorDataQoS.
//
// plain_reader DOMAIN TOPIC
#include <dds/dds.h>

#include <cstdlib>
#include <span>

#include "PointCloud2.h"
#include "cloud_pattern.hpp"

int main(int argc, char** argv) {
  using terracut::interop::Checker;
  if (argc != 3) return 2;
  const auto domain = static_cast<dds_domainid_t>(std::atoi(argv[1]));
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  const dds_entity_t topic = dds_create_topic(participant, &sensor_msgs_msg_dds__PointCloud2__desc,
                                              argv[2], nullptr, nullptr);
  dds_qos_t* qos = dds_create_qos();  // SensorDataQoS
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 5);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  dds_delete_qos(qos);
  if (reader < 0) return 3;
  const dds_entity_t waiting = dds_create_waitset(participant);
  dds_set_status_mask(reader, DDS_SUBSCRIPTION_MATCHED_STATUS | DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waiting, reader, 0);
  Checker::say("listening");

  Checker checker;
  while (!checker.has_all()) {
    dds_waitset_wait(waiting, nullptr, 0, DDS_INFINITY);
    dds_subscription_matched_status_t matched{};
    dds_get_subscription_matched_status(reader, &matched);
    if (matched.current_count_change > 0) Checker::say("matched", matched.current_count);
    void* samples[8] = {};
    dds_sample_info_t info[8];
    const dds_return_t taken = dds_take(reader, samples, info, 8, 8);
    for (dds_return_t i = 0; i < taken; ++i) {
      if (!info[i].valid_data) continue;
      const auto& cloud = *static_cast<const sensor_msgs_msg_dds__PointCloud2_*>(samples[i]);
      checker.check(static_cast<std::uint32_t>(cloud.header.stamp.sec), cloud.width,
                    cloud.point_step, cloud.fields._length, cloud.header.frame_id,
                    std::span(cloud.data._buffer, cloud.data._length));
    }
    if (taken > 0) dds_return_loan(reader, samples, taken);
    if (matched.current_count == 0 && matched.total_count > 0) return 1;  // the writer has gone
  }
  return 0;
}
