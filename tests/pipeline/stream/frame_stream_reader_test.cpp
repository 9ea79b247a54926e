// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/frame_stream_reader.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>

#include <cstring>
#include <string>

#include "stream_test_support.hpp"

namespace terracut::stream {
namespace {

/// A reader whose stream the test writes byte by byte.
class FrameStreamReaderTest : public testing::Test {
 protected:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    sender_ = files::OwnedDescriptor(ends[0]);
    reader_ = FrameStreamReader(files::OwnedDescriptor(ends[1]));
  }

  void send(const void* bytes, std::size_t count) {
    ASSERT_EQ(::send(sender_.get(), bytes, count, MSG_NOSIGNAL), static_cast<::ssize_t>(count));
  }
  void send(const FrameWireHeader& header) { send(&header, sizeof header); }
  void send_points(const std::vector<LabelledPoint>& points) {
    send(points.data(), points.size() * sizeof(LabelledPoint));
  }
  [[nodiscard]] Error error_of_next() {
    auto result = reader_.next(frame_, kTestPatience_ns);
    if (result) return {ErrorCode::kNotFound, "no error at all"};
    return result.error();
  }

  files::OwnedDescriptor sender_;
  FrameStreamReader reader_{files::OwnedDescriptor()};
  ReceivedFrame frame_;
};

TEST_F(FrameStreamReaderTest, ReadsFramesOneAfterAnotherUntilTheEnd) {
  for (std::uint32_t number = 0; number < 3; ++number) {
    send(FrameWireHeader{.number = number, .points = number});
    send_points(points_of_frame(number, number));
  }
  sender_.close();
  for (std::uint32_t number = 0; number < 3; ++number) {
    ASSERT_TRUE(reader_.next(frame_, kTestPatience_ns).value_or(false));
    EXPECT_EQ(frame_.header.number, number);
    EXPECT_EQ(frame_.points, points_of_frame(number, number));
  }
  const auto end = reader_.next(frame_, kTestPatience_ns);
  ASSERT_TRUE(end.has_value()) << end.error().message;
  EXPECT_FALSE(*end);
}

TEST_F(FrameStreamReaderTest, SkipsWhatALaterSenderAddedToHeaderAndPoints) {
  constexpr std::size_t kPoints = 2500, kPointBytes = 20;
  send(FrameWireHeader{.header_bytes = 60, .points = kPoints, .point_bytes = kPointBytes});
  send("more", 4);
  const auto points = points_of_frame(5, kPoints);
  std::string wide;
  for (const LabelledPoint& point : points) {
    wide.append(reinterpret_cast<const char*>(&point), sizeof point).append("time");
  }
  send(wide.data(), wide.size());
  ASSERT_TRUE(reader_.next(frame_, kTestPatience_ns).value_or(false));
  EXPECT_EQ(frame_.points, points);
}

TEST_F(FrameStreamReaderTest, AStreamThatEndsWithinAFrameIsAnError) {
  for (const std::size_t points_sent : {std::size_t{0}, std::size_t{9}}) {
    SetUp();
    send(FrameWireHeader{.points = 10});
    send_points(points_of_frame(0, points_sent));
    sender_.close();
    const Error error = error_of_next();
    EXPECT_EQ(error.code, ErrorCode::kMalformed);
    EXPECT_THAT(error.message, testing::HasSubstr("ended within a frame"));
  }
}

TEST_F(FrameStreamReaderTest, AStreamThatEndsWithinAHeaderIsAnError) {
  for (const std::size_t bytes : {std::size_t{3}, std::size_t{30}}) {
    SetUp();
    const FrameWireHeader header;
    send(&header, bytes);
    sender_.close();
    EXPECT_EQ(error_of_next().code, ErrorCode::kMalformed);
  }
}

TEST_F(FrameStreamReaderTest, AnotherServerIsRecognisedByItsFirstBytes) {
  const std::string greeting = "HTTP/1.1 400 Bad Request\r\n";
  send(greeting.data(), greeting.size());
  const Error error = error_of_next();
  EXPECT_EQ(error.code, ErrorCode::kMalformed);
  EXPECT_THAT(error.message, testing::HasSubstr("no labelled frame"));
}

TEST_F(FrameStreamReaderTest, LosesPatienceWithASenderThatSendsNothing) {
  send(FrameWireHeader{.points = 10});
  const auto result = reader_.next(frame_, 2'000'000);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kUnreadable);
  EXPECT_THAT(result.error().message, testing::HasSubstr("for 2 ms"));
}

TEST_F(FrameStreamReaderTest, SaysWhereNobodyServes) {
  const auto reader = FrameStreamReader::connect({.unix_path = "./no_such_socket"});
  ASSERT_FALSE(reader.has_value());
  EXPECT_EQ(reader.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(reader.error().message, testing::HasSubstr("./no_such_socket"));
}

}  // namespace
}  // namespace terracut::stream
