// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/turn_stream_reader.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>

#include <cstring>
#include <string>

#include "stream_test_support.hpp"

namespace terracut::stream {
namespace {

/// A reader whose stream the test writes byte by byte.
class TurnStreamReaderTest : public testing::Test {
 protected:
  void SetUp() override {
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    sender_ = files::OwnedDescriptor(ends[0]);
    reader_ = TurnStreamReader(files::OwnedDescriptor(ends[1]));
  }

  void send(const void* bytes, std::size_t count) {
    ASSERT_EQ(::send(sender_.get(), bytes, count, MSG_NOSIGNAL), static_cast<::ssize_t>(count));
  }
  void send(const TurnWireHeader& header) { send(&header, sizeof header); }
  void send_points(const std::vector<LabelledPoint>& points) {
    send(points.data(), points.size() * sizeof(LabelledPoint));
  }
  [[nodiscard]] Error error_of_next() {
    auto result = reader_.next(turn_, kTestPatience_ns);
    if (result) return {ErrorCode::kNotFound, "no error at all"};
    return result.error();
  }

  files::OwnedDescriptor sender_;
  TurnStreamReader reader_{files::OwnedDescriptor()};
  ReceivedTurn turn_;
};

TEST_F(TurnStreamReaderTest, ReadsTurnsOneAfterAnotherUntilTheEnd) {
  for (std::uint32_t number = 0; number < 3; ++number) {
    send(TurnWireHeader{.number = number, .points = number});
    send_points(points_of_turn(number, number));
  }
  sender_.close();
  for (std::uint32_t number = 0; number < 3; ++number) {
    ASSERT_TRUE(reader_.next(turn_, kTestPatience_ns).value_or(false));
    EXPECT_EQ(turn_.header.number, number);
    EXPECT_EQ(turn_.points, points_of_turn(number, number));
  }
  const auto end = reader_.next(turn_, kTestPatience_ns);
  ASSERT_TRUE(end.has_value()) << end.error().message;
  EXPECT_FALSE(*end);
}

TEST_F(TurnStreamReaderTest, SkipsWhatALaterSenderAddedToHeaderAndPoints) {
  constexpr std::size_t kPoints = 2500, kPointBytes = 20;
  send(TurnWireHeader{.header_bytes = 60, .points = kPoints, .point_bytes = kPointBytes});
  send("more", 4);
  const auto points = points_of_turn(5, kPoints);
  std::string wide;
  for (const LabelledPoint& point : points) {
    wide.append(reinterpret_cast<const char*>(&point), sizeof point).append("time");
  }
  send(wide.data(), wide.size());
  ASSERT_TRUE(reader_.next(turn_, kTestPatience_ns).value_or(false));
  EXPECT_EQ(turn_.points, points);
}

TEST_F(TurnStreamReaderTest, AStreamThatEndsWithinATurnIsAnError) {
  for (const std::size_t points_sent : {std::size_t{0}, std::size_t{9}}) {
    SetUp();
    send(TurnWireHeader{.points = 10});
    send_points(points_of_turn(0, points_sent));
    sender_.close();
    const Error error = error_of_next();
    EXPECT_EQ(error.code, ErrorCode::kMalformed);
    EXPECT_THAT(error.message, testing::HasSubstr("ended within a turn"));
  }
}

TEST_F(TurnStreamReaderTest, AStreamThatEndsWithinAHeaderIsAnError) {
  for (const std::size_t bytes : {std::size_t{3}, std::size_t{30}}) {
    SetUp();
    const TurnWireHeader header;
    send(&header, bytes);
    sender_.close();
    EXPECT_EQ(error_of_next().code, ErrorCode::kMalformed);
  }
}

TEST_F(TurnStreamReaderTest, AnotherServerIsRecognisedByItsFirstBytes) {
  const std::string greeting = "HTTP/1.1 400 Bad Request\r\n";
  send(greeting.data(), greeting.size());
  const Error error = error_of_next();
  EXPECT_EQ(error.code, ErrorCode::kMalformed);
  EXPECT_THAT(error.message, testing::HasSubstr("no labelled turn"));
}

TEST_F(TurnStreamReaderTest, LosesPatienceWithASenderThatSendsNothing) {
  send(TurnWireHeader{.points = 10});
  const auto result = reader_.next(turn_, 2'000'000);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kUnreadable);
  EXPECT_THAT(result.error().message, testing::HasSubstr("for 2 ms"));
}

TEST_F(TurnStreamReaderTest, SaysWhereNobodyServes) {
  const auto reader = TurnStreamReader::connect({.unix_path = "./no_such_socket"});
  ASSERT_FALSE(reader.has_value());
  EXPECT_EQ(reader.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(reader.error().message, testing::HasSubstr("./no_such_socket"));
}

}  // namespace
}  // namespace terracut::stream
