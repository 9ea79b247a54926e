// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/frame_stream_server.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <thread>

#include "stream_test_support.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::stream {
namespace {

/// More than every buffer between the two ends takes from a reader with a small receive buffer.
constexpr std::size_t kManyPoints = 500'000;
constexpr int kSmallBuffer_bytes = 16'384;
constexpr std::size_t kSmallSendBuffer_bytes = 65'536;

class FrameStream : public StreamTest {
 protected:
  void expect_frame(FrameStreamReader& reader, std::uint32_t number, std::size_t points) {
    ReceivedFrame frame;
    const auto result = receive(reader, frame);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    ASSERT_TRUE(*result) << "the stream ended";
    EXPECT_EQ(frame.header.number, number);
    EXPECT_EQ(frame.points, on_wire(points_of_frame(number, points)));
  }
  void serve(std::uint32_t number, std::size_t points) {
    ASSERT_TRUE(server().serve(frame_of(number, points_of_frame(number, points))));
  }
  [[nodiscard]] bool steps_until(const auto& done) {
    return step_until([this] { step(); }, done);
  }
  [[nodiscard]] static std::size_t open_descriptors() {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
  }
};

TEST_P(FrameStream, HandsOverHeaderAndPointsAsTheyWereGiven) {
  open({.max_points = 1000});
  FrameStreamReader first = reader();
  const auto points = points_of_frame(7, 1000);
  status::FrameRecord given = record_of(7);
  given.level = status::Level::kCoarse;
  given.info.deskew.state = frame::DeskewState::kDone;
  ASSERT_TRUE(server().serve(frame_of(given, points, true)));
  ReceivedFrame frame;
  ASSERT_TRUE(receive(first, frame).value_or(false));
  EXPECT_EQ(frame.header, (FrameWireHeader{.number = 7,
                                           .points = 1000,
                                           .first_packet_ns = given.info.first_packet_ns,
                                           .last_packet_ns = given.info.last_packet_ns,
                                           .labels_ns = given.labels_ns,
                                           .sensor = 1,
                                           .level = 2,
                                           .flags = kFrameComplete | kFrameLate | kFrameDeskewed}));
  EXPECT_EQ(frame.points, on_wire(points));
  given.info.deskew.state = frame::DeskewState::kNoEgoMotion;
  ASSERT_TRUE(server().serve(frame_of(given, points, true)));
  ASSERT_TRUE(receive(first, frame).value_or(false));
  EXPECT_EQ(frame.header.flags, kFrameComplete | kFrameLate | kFrameNoEgoMotion);
}

TEST_P(FrameStream, PointsComeWithTheirHeightsWhereTheStreamHasThem) {
  open({.max_points = 1000, .has_heights = true});
  FrameStreamReader only = reader();
  const auto points = points_of_frame(7, 1000);
  std::vector<float> heights_m(points.size());
  for (std::size_t n = 0; n < heights_m.size(); ++n) heights_m[n] = 0.25F * static_cast<float>(n);
  LabelledFrame given = frame_of(7, points);
  given.heights_m = heights_m;
  ASSERT_TRUE(server().serve(given));
  ReceivedFrame frame;
  ASSERT_TRUE(receive(only, frame).value_or(false));
  EXPECT_EQ(frame.header.version, kFrameWireVersion);
  EXPECT_EQ(frame.header.point_bytes, 24);
  EXPECT_EQ(frame.points, on_wire(points));
  EXPECT_EQ(frame.heights_m, heights_m);
  EXPECT_EQ(figures().bytes, sizeof(FrameWireHeader) + 1000 * 24);
}

TEST_P(FrameStream, PointsComeWithTheirObjectsWhereTheStreamHasThem) {
  open({.max_points = 1000, .has_objects = true});
  FrameStreamReader only = reader();
  const auto points = points_of_frame(7, 1000);
  const std::vector<float> heights_m(points.size(), 0.5F);
  std::vector<std::uint16_t> objects(points.size());
  for (std::size_t n = 0; n < objects.size(); ++n) objects[n] = static_cast<std::uint16_t>(n % 9);
  LabelledFrame given = frame_of(7, points);
  given.heights_m = heights_m;
  given.objects = objects;
  ASSERT_TRUE(server().serve(given));
  ReceivedFrame frame;
  ASSERT_TRUE(receive(only, frame).value_or(false));
  EXPECT_EQ(frame.header.point_bytes, 28);
  EXPECT_EQ(frame.points, on_wire(points));
  EXPECT_EQ(frame.heights_m, heights_m);
  EXPECT_EQ(frame.objects, std::vector<std::uint32_t>(objects.begin(), objects.end()));
}

TEST_P(FrameStream, EveryReaderGetsTheWholeFrame) {
  open({.max_points = kManyPoints});
  std::vector<FrameStreamReader> readers;
  for (int n = 0; n < 3; ++n) readers.push_back(reader());
  serve(0, kManyPoints);
  for (FrameStreamReader& each : readers) expect_frame(each, 0, kManyPoints);
  EXPECT_EQ(figures().sent, 3U);
  EXPECT_EQ(figures().missed, 0U);
  EXPECT_EQ(figures().bytes, 3 * (sizeof(FrameWireHeader) + kManyPoints * sizeof(WirePoint)));
}

TEST_P(FrameStream, AFrameWithoutPointsIsAFrame) {
  open({.max_points = 10});
  FrameStreamReader only = reader();
  serve(3, 0);
  expect_frame(only, 3, 0);
}

TEST_P(FrameStream, WithoutReadersAFrameIsGoneAtOnce) {
  open({.max_points = 10});
  serve(0, 10);
  FrameStreamReader late = reader();
  serve(1, 10);
  expect_frame(late, 1, 10);
  EXPECT_EQ(figures().frames, 2U);
  EXPECT_EQ(figures().sent, 1U);
  EXPECT_EQ(figures().missed, 0U);
}

TEST_P(FrameStream, AFrameWithMorePointsThanPlannedIsRefusedAndCounted) {
  open({.max_points = 10});
  FrameStreamReader only = reader();
  const auto points = points_of_frame(0, 11);
  EXPECT_FALSE(server().serve(frame_of(0, points)));
  EXPECT_EQ(figures().frames_too_large, 1U);
  serve(1, 10);
  expect_frame(only, 1, 10);
}

TEST_P(FrameStream, ASlowReaderMissesWholeFramesAndAQuickOneNone) {
  open({.max_points = kManyPoints});
  FrameStreamReader slow = reader(kSmallBuffer_bytes);
  FrameStreamReader quick = reader();
  for (std::uint32_t number = 0; number < 5; ++number) {
    serve(number, kManyPoints);
    expect_frame(quick, number, kManyPoints);
  }
  EXPECT_EQ(server().peer(0).missed, 4U);
  EXPECT_EQ(server().peer(1).missed, 0U);
  EXPECT_EQ(server().peer(1).sent, 5U);
  EXPECT_EQ(figures().missed, 4U);

  expect_frame(slow, 0, kManyPoints);
  serve(5, 10);
  expect_frame(quick, 5, 10);
  ReceivedFrame frame;
  ASSERT_TRUE(receive(slow, frame).value_or(false));
  EXPECT_EQ(frame.header.number, 5U) << "the newest one, none of those between";
  EXPECT_EQ(frame.header.missed, 4U);
  EXPECT_EQ(frame.points, on_wire(points_of_frame(5, 10)));
}

TEST_P(FrameStream, ReadersStuckInDifferentFramesLeaveRoomForTheOthers) {
  open({.max_points = kManyPoints, .max_peers = 4, .send_buffer_bytes = kSmallSendBuffer_bytes});
  std::vector<FrameStreamReader> stuck;
  for (std::uint32_t number = 0; number < 3; ++number) {
    stuck.push_back(reader(kSmallBuffer_bytes));
    serve(number, kManyPoints);
  }
  FrameStreamReader quick = reader();
  for (std::uint32_t number = 3; number < 6; ++number) {
    serve(number, kManyPoints);
    expect_frame(quick, number, kManyPoints);
  }
  for (std::uint32_t number = 0; number < 3; ++number) {
    expect_frame(stuck[number], number, kManyPoints);
  }
}

TEST_P(FrameStream, AReaderThatNeverReadsIsDisconnectedAndItsPlaceFree) {
  open({.max_points = kManyPoints, .max_peers = 1, .stall_limit_ns = 20'000'000});
  const files::OwnedDescriptor never_reads = join(kSmallBuffer_bytes);
  serve(0, kManyPoints);
  ASSERT_TRUE(steps_until([&] { return figures().stalled == 1; }));
  EXPECT_EQ(server().peers(), 0U);
  FrameStreamReader next = reader();
  serve(1, 1000);
  expect_frame(next, 1, 1000);
}

TEST_P(FrameStream, AReaderThatIsFreeIsNeverStalled) {
  constexpr std::int64_t kLimit_ns = 1'000'000;
  open({.max_points = 100, .stall_limit_ns = kLimit_ns});
  FrameStreamReader only = reader();
  for (std::uint32_t number = 0; number < 2; ++number) {
    serve(number, 100);
    ReceivedFrame frame;  // so little is there without another step
    ASSERT_TRUE(only.next(frame, kTestPatience_ms).value_or(false));
    const std::int64_t end_ns = measure::monotonic_ns() + 3 * kLimit_ns;
    ASSERT_TRUE(steps_until([&] { return measure::monotonic_ns() > end_ns; }));
  }
  EXPECT_EQ(figures().stalled, 0U);
  EXPECT_EQ(figures().sent, 2U);
}

TEST_P(FrameStream, AReaderKilledInTheMiddleOfAFrameHarmsNobody) {
  open({.max_points = kManyPoints, .send_buffer_bytes = kSmallSendBuffer_bytes});
  FrameStreamReader survivor = reader();
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const ::pid_t victim = ::fork();
  ASSERT_GE(victim, 0);
  if (victim == 0) {
    const files::OwnedDescriptor socket = dial(kSmallBuffer_bytes);
    char some[1000];
    const bool begun = ::recv(socket.get(), some, sizeof some, MSG_WAITALL) == sizeof some;
    if (!begun || ::write(told[1], "x", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  ASSERT_TRUE(steps_until([&] { return figures().connected == 2; }));
  serve(0, kManyPoints);
  char word = 0;
  ASSERT_EQ(::read(told[0], &word, 1), 1);
  ::close(told[0]);
  ::close(told[1]);
  ASSERT_EQ(figures().left, 0U);
  ::kill(victim, SIGKILL);
  ::waitpid(victim, nullptr, 0);
  ASSERT_TRUE(steps_until([&] { return figures().left == 1; }));
  expect_frame(survivor, 0, kManyPoints);
  serve(1, kManyPoints);
  expect_frame(survivor, 1, kManyPoints);
  EXPECT_EQ(figures().sent, 2U);
  EXPECT_EQ(figures().cut_short, 1U);
  EXPECT_EQ(server().peer(1).connected, false);
}

TEST_P(FrameStream, ReadersThatGoInTheMiddleOfAFrameLeaveNothingBehind) {
  open({.max_points = kManyPoints, .max_peers = 1, .send_buffer_bytes = kSmallSendBuffer_bytes});
  for (std::uint32_t number = 0; number < 20; ++number) {
    files::OwnedDescriptor socket = join(kSmallBuffer_bytes);
    serve(number, kManyPoints);
    socket.close();
    ASSERT_TRUE(steps_until([&] { return server().peers() == 0; }));
  }
  EXPECT_EQ(figures().connected, 20U);
  EXPECT_EQ(figures().left, 20U);
  EXPECT_EQ(figures().cut_short, 20U);
  FrameStreamReader next = reader();
  serve(20, kManyPoints);
  expect_frame(next, 20, kManyPoints);
}

TEST_P(FrameStream, AReaderThatGoesWhileItIsBeingServedRaisesNoSignal) {
  open({.max_points = kManyPoints});
  const auto points = points_of_frame(0, kManyPoints);
  for (int round = 0; round < 40; ++round) {
    std::array<files::OwnedDescriptor, 4> sockets;
    for (files::OwnedDescriptor& socket : sockets) socket = join();
    std::atomic<bool> serving = false;
    const std::jthread closer([&] {
      while (!serving) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::microseconds(200 * (round % 10)));
      for (files::OwnedDescriptor& socket : sockets) socket.close();
    });
    serving = true;
    // SIGPIPE would end the test program.
    ASSERT_TRUE(server().serve(frame_of(0, points)));
    ASSERT_TRUE(steps_until([&] { return server().peers() == 0; }));
  }
  EXPECT_EQ(figures().left, 160U);
}

TEST_P(FrameStream, ManyComeAndGoWhileOneReads) {
  open({.max_points = 20'000});
  FrameStreamReader steady = reader();
  const std::size_t descriptors = open_descriptors();
  for (std::uint32_t number = 0; number < 100; ++number) {
    std::array<files::OwnedDescriptor, 3> visitors;
    for (files::OwnedDescriptor& visitor : visitors) visitor = dial();
    serve(number, 20'000);
    for (files::OwnedDescriptor& visitor : visitors) visitor.close();
    expect_frame(steady, number, 20'000);
  }
  ASSERT_TRUE(steps_until([&] { return server().peers() == 1; }));
  EXPECT_EQ(figures().connected + figures().refused, 301U);
  EXPECT_EQ(figures().left, figures().connected - 1);
  EXPECT_EQ(server().peer(0).sent, 100U);
  EXPECT_EQ(open_descriptors(), descriptors) << "of those that left none is kept";
}

TEST_P(FrameStream, WhoComesWhenAllPlacesAreTakenIsTurnedAway) {
  open({.max_points = 100, .max_peers = 2});
  FrameStreamReader first = reader(), second = reader();
  FrameStreamReader third(dial());
  ReceivedFrame frame;
  const auto result = receive(third, frame);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_FALSE(*result) << "the stream ends before it began";
  EXPECT_EQ(figures().refused, 1U);
  serve(0, 100);
  expect_frame(first, 0, 100);
  expect_frame(second, 0, 100);
}

TEST_P(FrameStream, WhatReadersSendIsIgnored) {
  open({.max_points = 1000});
  files::OwnedDescriptor chatty = join();
  const std::vector<char> words(1 << 20, 'w');
  ::send(chatty.get(), words.data(), words.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  ::pollfd polled{server().descriptor(), POLLIN, 0};
  server().work_round();
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "nothing to do about it";
  FrameStreamReader same(std::move(chatty));
  serve(0, 1000);
  expect_frame(same, 0, 1000);
}

TEST_P(FrameStream, AReaderThatEndsItsSendingIsTakenLeaveOf) {
  open({.max_points = 10});
  const files::OwnedDescriptor socket = join();
  ::shutdown(socket.get(), SHUT_WR);
  EXPECT_TRUE(steps_until([&] { return figures().left == 1; }));
}

TEST_P(FrameStream, ACallThatHasNothingToDoIsNotAskedFor) {
  open({.max_points = kManyPoints, .send_buffer_bytes = kSmallSendBuffer_bytes});
  ::pollfd polled{server().descriptor(), POLLIN, 0};
  EXPECT_EQ(::poll(&polled, 1, 0), 0);
  FrameStreamReader only = reader(kSmallBuffer_bytes);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "a free reader asks for nothing";
  serve(0, kManyPoints);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "neither does one that does not read";
  expect_frame(only, 0, kManyPoints);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "nor one that has its frame";
  const files::OwnedDescriptor another = dial();
  EXPECT_EQ(::poll(&polled, 1, kTestPatience_ms), 1);
}

/// The limit of descriptors of this process, lowered until the end of the test.
class FewDescriptors {
 public:
  explicit FewDescriptors(std::size_t count) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const ::rlimit few{count, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~FewDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  FewDescriptors(const FewDescriptors&) = delete;
  FewDescriptors& operator=(const FewDescriptors&) = delete;

 private:
  ::rlimit before_{};
};

TEST_P(FrameStream, WithoutDescriptorsItLetsNobodyInButGoesOn) {
  open({.max_points = 1000});
  FrameStreamReader before = reader();
  files::OwnedDescriptor knocking = dial();
  // Called without the fixture below: UBSan wants descriptors to look at objects with virtuals.
  FrameStreamServer& there = server();
  const auto points = points_of_frame(0, 1000);
  {
    const FewDescriptors few(3);
    there.work_round();
    EXPECT_EQ(there.figures().accept_failures, 1U);
    EXPECT_EQ(there.figures().accept_error, EMFILE);
    ::pollfd polled{there.descriptor(), POLLIN, 0};
    EXPECT_EQ(::poll(&polled, 1, 0), 0) << "who knocks must not keep the thread awake";
    EXPECT_TRUE(there.serve(frame_of(0, points)));
  }
  expect_frame(before, 0, 1000);
  ASSERT_TRUE(steps_until([&] { return figures().connected == 2; }));
  FrameStreamReader after(std::move(knocking));
  serve(1, 1000);
  expect_frame(after, 1, 1000);
}

TEST_P(FrameStream, AllocatesNothingOnceItIsOpen) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  open({.max_points = kManyPoints, .max_peers = 2});
  const auto points = points_of_frame(0, kManyPoints);
  std::array<files::OwnedDescriptor, 4> sockets;
  std::uint64_t allocated = 0;
  for (int round = 0; round < 5; ++round) {
    for (files::OwnedDescriptor& socket : sockets) socket = dial(kSmallBuffer_bytes);
    const std::uint64_t before = test::allocations_of_this_thread();
    server().work_round();
    (void)server().serve(frame_of(0, points));
    (void)server().serve(frame_of(1, points));
    for (files::OwnedDescriptor& socket : sockets) socket.close();
    server().work_round();
    allocated += test::allocations_of_this_thread() - before;
  }
  EXPECT_EQ(allocated, 0U);
  EXPECT_GT(figures().missed, 0U);
  EXPECT_GT(figures().refused, 0U);
}

/// What one reader of its own pace saw.
struct Seen {
  std::uint64_t frames = 0;
  std::uint64_t wrong = 0;
  std::uint32_t missed = 0;  ///< As the last header says.
  std::uint32_t last = 0;
};

Seen read_all(FrameStreamReader reader, std::chrono::microseconds pause) {
  Seen seen;
  ReceivedFrame frame;
  for (;;) {
    const auto result = reader.next(frame, kTestPatience_ms);
    if (!result) ++seen.wrong;
    if (!result || !*result) return seen;
    const std::uint32_t number = frame.header.number;
    // Every frame before this one was either seen or is counted as missed.
    if (seen.frames + frame.header.missed != number) ++seen.wrong;
    if (frame.points != on_wire(points_of_frame(number, frame.header.points))) ++seen.wrong;
    ++seen.frames;
    seen.missed = frame.header.missed;
    seen.last = number;
    std::this_thread::sleep_for(pause);
  }
}

TEST_P(FrameStream, ReadersOfAnyPaceSeeWholeFramesAndHowManyTheyMissed) {
  constexpr std::size_t kReaders = 4;
  constexpr std::uint32_t kFrames = 150;
  open({.max_points = 60'000, .max_peers = kReaders, .send_buffer_bytes = kSmallSendBuffer_bytes});
  std::vector<std::future<Seen>> results;
  for (std::size_t n = 0; n < kReaders; ++n) {
    FrameStreamReader each = reader(n % 2 == 0 ? 0 : 65'536);
    const std::chrono::microseconds pause(n * n * 1500);
    results.push_back(std::async(
        std::launch::async,
        [pause](FrameStreamReader own) { return read_all(std::move(own), pause); },
        std::move(each)));
  }
  for (std::uint32_t number = 0; number < kFrames; ++number) {
    serve(number, 30'000 + number * 200);
    for (int n = 0; n < 2; ++n) step();
  }
  // None is being sent any more: all that was begun is in the kernel, and comes through.
  ASSERT_TRUE(steps_until([&] { return figures().sent + figures().missed == kReaders * kFrames; }));
  const FrameStreamFigures last = figures();
  std::array<PeerFigures, kReaders> peers;
  for (std::size_t n = 0; n < kReaders; ++n) peers[n] = server().peer(n);
  server_.reset();
  for (std::size_t n = 0; n < kReaders; ++n) {
    SCOPED_TRACE(n);
    const Seen seen = results[n].get();
    EXPECT_EQ(seen.wrong, 0U);
    EXPECT_EQ(seen.frames, peers[n].sent);
    EXPECT_EQ(seen.frames + peers[n].missed, kFrames);
  }
  EXPECT_EQ(last.frames, kFrames);
  EXPECT_EQ(last.cut_short, 0U);
  EXPECT_EQ(last.left + last.stalled, 0U);
}

INSTANTIATE_TEST_SUITE_P(Over, FrameStream, testing::Values(Transport::kTcp, Transport::kUnix),
                         transport_name);

TEST(FrameStreamServer, RefusesSettingsOutOfTheirRanges) {
  const std::array configs{
      FrameStreamConfig{.max_points = 0},
      FrameStreamConfig{.max_points = kMostFramePoints + std::size_t{1}},
      FrameStreamConfig{.max_points = 1, .max_peers = 0},
      FrameStreamConfig{.max_points = 1, .max_peers = 65},
      FrameStreamConfig{.max_points = 1, .stall_limit_ns = 0},
  };
  for (const FrameStreamConfig& config : configs) {
    memory::FixedMemory memory;
    const auto server = FrameStreamServer::open(config, memory);
    ASSERT_FALSE(server.has_value());
    EXPECT_EQ(server.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(memory.total_bytes(), 0U);
  }
}

TEST(FrameStreamServer, TakesTheLeastOfEachSetting) {
  memory::FixedMemory memory;
  EXPECT_TRUE(
      FrameStreamServer::open({.max_points = 1, .max_peers = 1, .stall_limit_ns = 1}, memory)
          .has_value());
}

TEST(FrameStreamServer, TakesRoomForAFrameAReaderFromThePlannedMemory) {
  memory::FixedMemory memory;
  const auto server = FrameStreamServer::open({.max_points = 1000, .max_peers = 3}, memory);
  ASSERT_TRUE(server.has_value());
  EXPECT_GE(memory.total_bytes(), 3 * 1000 * sizeof(WirePoint));
  EXPECT_LE(memory.total_bytes(), 3 * 1000 * sizeof(WirePoint) + 1024);
}

TEST(FrameStreamServer, TellsWhatSendBufferItGot) {
  memory::FixedMemory memory;
  const auto server = FrameStreamServer::open({.max_points = 1000}, memory);
  ASSERT_TRUE(server.has_value());
  EXPECT_THAT(server->send_buffer().asked, testing::HasSubstr("20056 bytes"));
  EXPECT_TRUE(server->send_buffer().granted) << "every system lets a program have so little";
}

}  // namespace
}  // namespace terracut::stream
