// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/object_writer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "ros_types.h"
#include "tests/pipeline/dds/one_reader.hpp"

namespace terracut::dds {
namespace {

objects::Object object_at(float x_m, std::uint32_t first_return) {
  objects::Object object;
  object.first_return = first_return;
  object.top_m = 1.5F;
  object.box = {.middle = {x_m, 2}, .length_m = 4, .width_m = 2};
  return object;
}

struct BoxesOfObjects : testing::Test {
  void SetUp() override {
    auto opened =
        Participant::open({.domain = 1 + static_cast<int>(::getpid() % 200), .interface = "lo"});
    if (!opened) GTEST_SKIP() << opened.error().message;
    participant.emplace(*std::move(opened));
    auto made = ObjectWriter::open(*participant, topics, {});
    ASSERT_TRUE(made) << made.error().message;
    writer.emplace(*std::move(made));
  }

  const ObjectWriter::Topics topics{"rt/test/objects", "rt/test/objects/markers",
                                    "rt/test/sectors/objects"};
  std::string frame_id = "terracut_ground";
  std::optional<Participant> participant;
  std::optional<ObjectWriter> writer;
};

TEST_F(BoxesOfObjects, OfAFrameAreNumberedFromOne) {
  OneReader<vision_msgs_msg_dds__Detection3DArray_> boxes(
      *participant, topics.boxes, vision_msgs_msg_dds__Detection3DArray__desc);
  publish::LabelledFrame frame;
  frame.record.info.first_packet_ns = 5'250'000'000;
  frame.objects = {object_at(10, 7), object_at(20, 9)};
  ASSERT_TRUE(writer->write(frame, frame_id));
  const auto* message = boxes.take();
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message->header.stamp.sec, 5);
  ASSERT_EQ(message->detections._length, 2U);
  EXPECT_STREQ(message->detections._buffer[0].id, "1");
  EXPECT_STREQ(message->detections._buffer[1].id, "2");
  EXPECT_EQ(message->detections._buffer[1].bbox.center.position.x, 20);
}

TEST_F(BoxesOfObjects, OfASectorAreCalledByTheirFirstReturnAndStampedByTheirLast) {
  OneReader<vision_msgs_msg_dds__Detection3DArray_> boxes(
      *participant, topics.sector_boxes, vision_msgs_msg_dds__Detection3DArray__desc);
  publish::LabelledSector sector;
  sector.record.first_packet_ns = 5'250'000'000;
  ASSERT_TRUE(writer->write(sector, frame_id));  // without an object no message
  sector.objects = {{object_at(10, 7000), 3, 4'000'000'000}};
  ASSERT_TRUE(writer->write(sector, frame_id));
  const auto* message = boxes.take();
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message->header.stamp.sec, 5);
  ASSERT_EQ(message->detections._length, 1U);
  EXPECT_STREQ(message->detections._buffer[0].id, "7000");
  EXPECT_EQ(message->detections._buffer[0].header.stamp.sec, 4);
  EXPECT_EQ(message->detections._buffer[0].bbox.size.z, 1.5);
}

}  // namespace
}  // namespace terracut::dds
