// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/transform_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "pipeline/dds/ros_time.hpp"
#include "pipeline/dds/topic_writer.hpp"

namespace terracut::dds {
namespace {

constexpr const char* kTopic = "rt/tf_static";

/// Somebody who says once where a sensor is.
Expected<TopicWriter> say(const Participant& participant, double z_m) {
  auto writer = TopicWriter::open(participant, kTopic, kTfMessage,
                                  {.reliable = true, .depth = 1, .latched = true});
  if (!writer) return writer;
  std::string parent = "base_link", child = "/lidar_top";
  geometry_msgs_msg_dds__TransformStamped_ transform{
      {ros_time(1), parent.data()}, child.data(), {{1, 0, z_m}, {0, 0, 0, 1}}};
  const tf2_msgs_msg_dds__TFMessage_ message{{1, 1, &transform, false}};
  EXPECT_TRUE(writer->write(&message));
  return writer;
}

double height_once_known(TransformReader& reader, double other_than_m) {
  while (true) {
    const auto T = reader.tree().transform("lidar_top", "base_link");
    if (T && (*T)[11] != other_than_m) return (*T)[11];
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST(TransformReader, KnowsWhatWasSaidBeforeItCameAndTheNewestOfAFrame) {
  const int domain = 1 + static_cast<int>(::getpid() % 200);
  const auto participant = Participant::open({.domain = domain, .interface = "lo"});
  ASSERT_TRUE(participant) << participant.error().message;
  const auto before = say(*participant, 2.5);
  ASSERT_TRUE(before);
  auto reader = TransformReader::open(*participant, kTopic);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(height_once_known(*reader, 0), 2.5);
  const auto again = say(*participant, 1.5);
  ASSERT_TRUE(again);
  EXPECT_EQ(height_once_known(*reader, 2.5), 1.5);
}

}  // namespace
}  // namespace terracut::dds
