// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "topic_writer.hpp"

#include <fmt/format.h>

#include "ros_types.h"

namespace terracut::dds {

const MessageType kPointCloud2{
    &sensor_msgs_msg_dds__PointCloud2__desc,
    "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"};
const MessageType kDiagnosticArray{
    &diagnostic_msgs_msg_dds__DiagnosticArray__desc,
    "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"};
const MessageType kTfMessage{
    &tf2_msgs_msg_dds__TFMessage__desc,
    "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"};
const MessageType kDetection3DArray{
    &vision_msgs_msg_dds__Detection3DArray__desc,
    "RIHS01_793f5eab9595ac1c0da07873cc859db42eae51f0ee76056db8562515d830e018"};
const MessageType kMarkerArray{
    &visualization_msgs_msg_dds__MarkerArray__desc,
    "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"};
const MessageType kLaserScan{
    &sensor_msgs_msg_dds__LaserScan__desc,
    "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"};
const MessageType kPolygonStamped{
    &geometry_msgs_msg_dds__PolygonStamped__desc,
    "RIHS01_b7cf07932f1523d4b4088075945c1a0141f7cd21da87cc940fc61652e9138b46"};
const MessageType kOccupancyGrid{
    &nav_msgs_msg_dds__OccupancyGrid__desc,
    "RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"};
const MessageType kFloat64Stamped{
    &autoware_internal_debug_msgs_msg_dds__Float64Stamped__desc,
    "RIHS01_588b194ed7eddc089b6ca098eb093e92f29bdad96ebd906fc9282816335942eb"};

Qos qos_of(const MessageType& type, const Quality& quality) {
  Qos qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(qos.get(),
                       quality.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos.get(),
                      quality.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, quality.depth);
  if (type.hash != nullptr) {
    const std::string told = fmt::format("typehash={};", type.hash);
    dds_qset_userdata(qos.get(), told.data(), told.size());
  }
  return qos;
}

Expected<TopicWriter> TopicWriter::open(const Participant& participant, const std::string& topic,
                                        const MessageType& type, const Quality& quality) {
  Entity named(
      dds_create_topic(participant.id(), type.descriptor, topic.c_str(), nullptr, nullptr));
  if (named.id() < 0) {
    return refused(ErrorCode::kInvalidArgument, "topic " + topic, named.id());
  }
  Entity writer(
      dds_create_writer(participant.id(), named.id(), qos_of(type, quality).get(), nullptr));
  if (writer.id() < 0) {
    return refused(ErrorCode::kInvalidArgument, "a writer of " + topic, writer.id());
  }
  return TopicWriter(std::move(named), std::move(writer), topic);
}

Status TopicWriter::write(const void* message) {
  const dds_return_t returned = dds_write(writer_.id(), message);
  if (returned < 0) return refused(ErrorCode::kWriteFailed, "writing to " + name_, returned);
  return {};
}

bool TopicWriter::is_acknowledged(std::int64_t patience_ns) {
  return dds_wait_for_acks(writer_.id(), patience_ns) == DDS_RETCODE_OK;
}

std::uint32_t TopicWriter::readers() const {
  dds_publication_matched_status_t matched{};
  if (dds_get_publication_matched_status(writer_.id(), &matched) < 0) return 0;
  return matched.current_count;
}

}  // namespace terracut::dds
