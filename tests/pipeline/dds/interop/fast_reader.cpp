// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Fast DDS, the other vendor's stack and ROS 2's default one, reads clouds reliably on loopback.
//
// fast_reader DOMAIN TOPIC
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <cstdlib>
#include <memory>
#include <thread>

#include "PointCloud2PubSubTypes.h"
#include "cloud_pattern.hpp"

namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using terracut::interop::Checker;
using Cloud = sensor_msgs::msg::dds_::PointCloud2_;

class Listener : public fast::DataReaderListener {
 public:
  void on_subscription_matched(fast::DataReader*,
                               const fast::SubscriptionMatchedStatus& info) override {
    Checker::say(info.current_count > 0 ? "matched" : "left",
                 static_cast<std::uint32_t>(info.current_count));
    if (info.current_count == 0) std::_Exit(checker_.has_all() ? 0 : 1);
  }
  void on_data_available(fast::DataReader* reader) override {
    fast::SampleInfo info;
    while (reader->take_next_sample(&cloud_, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      checker_.check(static_cast<std::uint32_t>(cloud_.header().stamp().sec()), cloud_.width(),
                     cloud_.point_step(), cloud_.fields().size(), cloud_.header().frame_id(),
                     cloud_.data());
      if (checker_.has_all()) std::_Exit(0);
    }
  }

 private:
  Cloud cloud_;
  Checker checker_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto domain = static_cast<std::uint32_t>(std::atoi(argv[1]));

  fast::DomainParticipantQos participant_qos = fast::PARTICIPANT_QOS_DEFAULT;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->receiveBufferSize = 8U << 20U;
  participant_qos.transport().use_builtin_transports = false;
  participant_qos.transport().user_transports.push_back(udp);
  for (std::uint32_t index = 0; index < 10; ++index) {  // participants of this machine
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
    peer.port = 7400 + 250 * domain + 10 + 2 * index;
    participant_qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  fast::DomainParticipant* participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(domain, participant_qos);
  if (participant == nullptr) return 3;
  const fast::TypeSupport type(new sensor_msgs::msg::dds_::PointCloud2_PubSubType());
  type.register_type(participant);
  fast::Topic* topic =
      participant->create_topic(argv[2], type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  fast::Subscriber* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  qos.history().depth = 5;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  Listener listener;
  if (topic == nullptr || subscriber == nullptr ||
      subscriber->create_datareader(topic, qos, &listener) == nullptr) {
    return 3;
  }
  Checker::say("listening");
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));  // the listener ends it
}
