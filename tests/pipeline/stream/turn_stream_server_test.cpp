// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/turn_stream_server.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

class TurnStream : public StreamTest {
 protected:
  /// Reads a turn while the server goes on; so large ones come through.
  Expected<bool> receive(TurnStreamReader& reader, ReceivedTurn& turn) {
    auto result =
        std::async(std::launch::async, [&] { return reader.next(turn, kTestPatience_ns); });
    while (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready) step();
    return result.get();
  }
  void expect_turn(TurnStreamReader& reader, std::uint32_t number, std::size_t points) {
    ReceivedTurn turn;
    const auto result = receive(reader, turn);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    ASSERT_TRUE(*result) << "the stream ended";
    EXPECT_EQ(turn.header.number, number);
    EXPECT_EQ(turn.points, points_of_turn(number, points));
  }
  void serve(std::uint32_t number, std::size_t points) {
    ASSERT_TRUE(server().serve(turn_of(number, points_of_turn(number, points))));
  }
  [[nodiscard]] bool steps_until(const auto& done) {
    return step_until([this] { step(); }, done);
  }
  [[nodiscard]] static std::size_t open_descriptors() {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
  }
};

TEST_P(TurnStream, HandsOverHeaderAndPointsAsTheyWereGiven) {
  open({.max_points = 1000});
  TurnStreamReader first = reader();
  const auto points = points_of_turn(7, 1000);
  LabelledTurn given = turn_of(7, points);
  given.rung = status::Rung::kCoarse;
  given.late = true;
  given.motion = status::FrameMotion::kTakenOut;
  ASSERT_TRUE(server().serve(given));
  ReceivedTurn turn;
  ASSERT_TRUE(receive(first, turn).value_or(false));
  EXPECT_EQ(turn.header,
            (TurnWireHeader{.number = 7,
                            .points = 1000,
                            .first_packet_ns = given.first_packet_ns,
                            .last_packet_ns = given.last_packet_ns,
                            .labels_ns = given.labels_ns,
                            .sensor = 1,
                            .rung = 2,
                            .flags = kTurnComplete | kTurnLate | kTurnMotionTakenOut}));
  EXPECT_EQ(turn.points, points);
  given.motion = status::FrameMotion::kNoEgoMotion;
  ASSERT_TRUE(server().serve(given));
  ASSERT_TRUE(receive(first, turn).value_or(false));
  EXPECT_EQ(turn.header.flags, kTurnComplete | kTurnLate | kTurnNoEgoMotion);
}

TEST_P(TurnStream, EveryReaderGetsTheWholeTurn) {
  open({.max_points = kManyPoints});
  std::vector<TurnStreamReader> readers;
  for (int n = 0; n < 3; ++n) readers.push_back(reader());
  serve(0, kManyPoints);
  for (TurnStreamReader& each : readers) expect_turn(each, 0, kManyPoints);
  EXPECT_EQ(figures().sent, 3U);
  EXPECT_EQ(figures().missed, 0U);
  EXPECT_EQ(figures().bytes, 3 * (sizeof(TurnWireHeader) + kManyPoints * sizeof(LabelledPoint)));
}

TEST_P(TurnStream, ATurnWithoutPointsIsATurn) {
  open({.max_points = 10});
  TurnStreamReader only = reader();
  serve(3, 0);
  expect_turn(only, 3, 0);
}

TEST_P(TurnStream, WithoutReadersATurnIsGoneAtOnce) {
  open({.max_points = 10});
  serve(0, 10);
  TurnStreamReader late = reader();
  serve(1, 10);
  expect_turn(late, 1, 10);
  EXPECT_EQ(figures().turns, 2U);
  EXPECT_EQ(figures().sent, 1U);
  EXPECT_EQ(figures().missed, 0U);
}

TEST_P(TurnStream, ATurnWithMorePointsThanPlannedIsRefusedAndCounted) {
  open({.max_points = 10});
  TurnStreamReader only = reader();
  const auto points = points_of_turn(0, 11);
  EXPECT_FALSE(server().serve(turn_of(0, points)));
  EXPECT_EQ(figures().turns_too_large, 1U);
  serve(1, 10);
  expect_turn(only, 1, 10);
}

TEST_P(TurnStream, ASlowReaderMissesWholeTurnsAndAQuickOneNone) {
  open({.max_points = kManyPoints});
  TurnStreamReader slow = reader(kSmallBuffer_bytes);
  TurnStreamReader quick = reader();
  for (std::uint32_t number = 0; number < 5; ++number) {
    serve(number, kManyPoints);
    expect_turn(quick, number, kManyPoints);
  }
  EXPECT_EQ(server().peer(0).missed, 4U);
  EXPECT_EQ(server().peer(1).missed, 0U);
  EXPECT_EQ(server().peer(1).sent, 5U);
  EXPECT_EQ(figures().missed, 4U);

  expect_turn(slow, 0, kManyPoints);
  serve(5, 10);
  expect_turn(quick, 5, 10);
  ReceivedTurn turn;
  ASSERT_TRUE(receive(slow, turn).value_or(false));
  EXPECT_EQ(turn.header.number, 5U) << "the newest one, none of those between";
  EXPECT_EQ(turn.header.missed, 4U);
  EXPECT_EQ(turn.points, points_of_turn(5, 10));
}

TEST_P(TurnStream, ReadersStuckInDifferentTurnsLeaveRoomForTheOthers) {
  open({.max_points = kManyPoints, .max_peers = 4, .send_buffer_bytes = kSmallSendBuffer_bytes});
  std::vector<TurnStreamReader> stuck;
  for (std::uint32_t number = 0; number < 3; ++number) {
    stuck.push_back(reader(kSmallBuffer_bytes));
    serve(number, kManyPoints);
  }
  TurnStreamReader quick = reader();
  for (std::uint32_t number = 3; number < 6; ++number) {
    serve(number, kManyPoints);
    expect_turn(quick, number, kManyPoints);
  }
  for (std::uint32_t number = 0; number < 3; ++number) {
    expect_turn(stuck[number], number, kManyPoints);
  }
}

TEST_P(TurnStream, AReaderThatNeverReadsIsDisconnectedAndItsPlaceFree) {
  open({.max_points = kManyPoints, .max_peers = 1, .stall_limit_ns = 20'000'000});
  const files::OwnedDescriptor never_reads = join(kSmallBuffer_bytes);
  serve(0, kManyPoints);
  ASSERT_TRUE(steps_until([&] { return figures().stalled == 1; }));
  EXPECT_EQ(server().peers(), 0U);
  TurnStreamReader next = reader();
  serve(1, 1000);
  expect_turn(next, 1, 1000);
}

TEST_P(TurnStream, AReaderThatIsFreeIsNeverStalled) {
  constexpr std::int64_t kLimit_ns = 1'000'000;
  open({.max_points = 100, .stall_limit_ns = kLimit_ns});
  TurnStreamReader only = reader();
  for (std::uint32_t number = 0; number < 2; ++number) {
    serve(number, 100);
    ReceivedTurn turn;  // so little is there without another step
    ASSERT_TRUE(only.next(turn, kTestPatience_ns).value_or(false));
    const std::int64_t end_ns = measure::monotonic_ns() + 3 * kLimit_ns;
    ASSERT_TRUE(steps_until([&] { return measure::monotonic_ns() > end_ns; }));
  }
  EXPECT_EQ(figures().stalled, 0U);
  EXPECT_EQ(figures().sent, 2U);
}

TEST_P(TurnStream, AReaderKilledInTheMiddleOfATurnHarmsNobody) {
  open({.max_points = kManyPoints, .send_buffer_bytes = kSmallSendBuffer_bytes});
  TurnStreamReader survivor = reader();
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
  expect_turn(survivor, 0, kManyPoints);
  serve(1, kManyPoints);
  expect_turn(survivor, 1, kManyPoints);
  EXPECT_EQ(figures().sent, 2U);
  EXPECT_EQ(figures().cut_short, 1U);
  EXPECT_EQ(server().peer(1).connected, false);
}

TEST_P(TurnStream, ReadersThatGoInTheMiddleOfATurnLeaveNothingBehind) {
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
  TurnStreamReader next = reader();
  serve(20, kManyPoints);
  expect_turn(next, 20, kManyPoints);
}

TEST_P(TurnStream, AReaderThatGoesWhileItIsBeingServedRaisesNoSignal) {
  open({.max_points = kManyPoints});
  const auto points = points_of_turn(0, kManyPoints);
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
    ASSERT_TRUE(server().serve(turn_of(0, points)));
    ASSERT_TRUE(steps_until([&] { return server().peers() == 0; }));
  }
  EXPECT_EQ(figures().left, 160U);
}

TEST_P(TurnStream, ManyComeAndGoWhileOneReads) {
  open({.max_points = 20'000});
  TurnStreamReader steady = reader();
  const std::size_t descriptors = open_descriptors();
  for (std::uint32_t number = 0; number < 100; ++number) {
    std::array<files::OwnedDescriptor, 3> visitors;
    for (files::OwnedDescriptor& visitor : visitors) visitor = dial();
    serve(number, 20'000);
    for (files::OwnedDescriptor& visitor : visitors) visitor.close();
    expect_turn(steady, number, 20'000);
  }
  ASSERT_TRUE(steps_until([&] { return server().peers() == 1; }));
  EXPECT_EQ(figures().connected + figures().refused, 301U);
  EXPECT_EQ(figures().left, figures().connected - 1);
  EXPECT_EQ(server().peer(0).sent, 100U);
  EXPECT_EQ(open_descriptors(), descriptors) << "of those that left none is kept";
}

TEST_P(TurnStream, WhoComesWhenAllPlacesAreTakenIsTurnedAway) {
  open({.max_points = 100, .max_peers = 2});
  TurnStreamReader first = reader(), second = reader();
  TurnStreamReader third(dial());
  ReceivedTurn turn;
  const auto result = receive(third, turn);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_FALSE(*result) << "the stream ends before it began";
  EXPECT_EQ(figures().refused, 1U);
  serve(0, 100);
  expect_turn(first, 0, 100);
  expect_turn(second, 0, 100);
}

TEST_P(TurnStream, WhatReadersSendIsIgnored) {
  open({.max_points = 1000});
  files::OwnedDescriptor chatty = join();
  const std::vector<char> words(1 << 20, 'w');
  ::send(chatty.get(), words.data(), words.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  ::pollfd polled{server().descriptor(), POLLIN, 0};
  server().turn_round();
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "nothing to do about it";
  TurnStreamReader same(std::move(chatty));
  serve(0, 1000);
  expect_turn(same, 0, 1000);
}

TEST_P(TurnStream, AReaderThatEndsItsSendingIsTakenLeaveOf) {
  open({.max_points = 10});
  const files::OwnedDescriptor socket = join();
  ::shutdown(socket.get(), SHUT_WR);
  EXPECT_TRUE(steps_until([&] { return figures().left == 1; }));
}

TEST_P(TurnStream, ACallThatHasNothingToDoIsNotAskedFor) {
  open({.max_points = kManyPoints, .send_buffer_bytes = kSmallSendBuffer_bytes});
  ::pollfd polled{server().descriptor(), POLLIN, 0};
  EXPECT_EQ(::poll(&polled, 1, 0), 0);
  TurnStreamReader only = reader(kSmallBuffer_bytes);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "a free reader asks for nothing";
  serve(0, kManyPoints);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "neither does one that does not read";
  expect_turn(only, 0, kManyPoints);
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "nor one that has its turn";
  const files::OwnedDescriptor another = dial();
  EXPECT_EQ(::poll(&polled, 1, static_cast<int>(kTestPatience_ns / 1'000'000)), 1);
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

TEST_P(TurnStream, WithoutDescriptorsItLetsNobodyInButGoesOn) {
  open({.max_points = 1000});
  TurnStreamReader before = reader();
  files::OwnedDescriptor knocking = dial();
  // Called without the fixture below: UBSan wants descriptors to look at objects with virtuals.
  TurnStreamServer& there = server();
  const auto points = points_of_turn(0, 1000);
  {
    const FewDescriptors few(3);
    there.turn_round();
    EXPECT_EQ(there.figures().accept_failures, 1U);
    EXPECT_EQ(there.figures().accept_error, EMFILE);
    ::pollfd polled{there.descriptor(), POLLIN, 0};
    EXPECT_EQ(::poll(&polled, 1, 0), 0) << "who knocks must not keep the thread awake";
    EXPECT_TRUE(there.serve(turn_of(0, points)));
  }
  expect_turn(before, 0, 1000);
  ASSERT_TRUE(steps_until([&] { return figures().connected == 2; }));
  TurnStreamReader after(std::move(knocking));
  serve(1, 1000);
  expect_turn(after, 1, 1000);
}

TEST_P(TurnStream, AllocatesNothingOnceItIsOpen) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  open({.max_points = kManyPoints, .max_peers = 2});
  const auto points = points_of_turn(0, kManyPoints);
  std::array<files::OwnedDescriptor, 4> sockets;
  std::uint64_t allocated = 0;
  for (int round = 0; round < 5; ++round) {
    for (files::OwnedDescriptor& socket : sockets) socket = dial(kSmallBuffer_bytes);
    const std::uint64_t before = test::allocations_of_this_thread();
    server().turn_round();
    (void)server().serve(turn_of(0, points));
    (void)server().serve(turn_of(1, points));
    for (files::OwnedDescriptor& socket : sockets) socket.close();
    server().turn_round();
    allocated += test::allocations_of_this_thread() - before;
  }
  EXPECT_EQ(allocated, 0U);
  EXPECT_GT(figures().missed, 0U);
  EXPECT_GT(figures().refused, 0U);
}

/// What one reader of its own pace saw.
struct Seen {
  std::uint64_t turns = 0;
  std::uint64_t wrong = 0;
  std::uint32_t missed = 0;  ///< As the last header says.
  std::uint32_t last = 0;
};

Seen read_all(TurnStreamReader reader, std::chrono::microseconds pause) {
  Seen seen;
  ReceivedTurn turn;
  for (;;) {
    const auto result = reader.next(turn, kTestPatience_ns);
    if (!result) ++seen.wrong;
    if (!result || !*result) return seen;
    const std::uint32_t number = turn.header.number;
    // Every turn before this one was either seen or is counted as missed.
    if (seen.turns + turn.header.missed != number) ++seen.wrong;
    if (turn.points != points_of_turn(number, turn.header.points)) ++seen.wrong;
    ++seen.turns;
    seen.missed = turn.header.missed;
    seen.last = number;
    std::this_thread::sleep_for(pause);
  }
}

TEST_P(TurnStream, ReadersOfAnyPaceSeeWholeTurnsAndHowManyTheyMissed) {
  constexpr std::size_t kReaders = 4;
  constexpr std::uint32_t kTurns = 150;
  open({.max_points = 60'000, .max_peers = kReaders, .send_buffer_bytes = kSmallSendBuffer_bytes});
  std::vector<std::future<Seen>> results;
  for (std::size_t n = 0; n < kReaders; ++n) {
    TurnStreamReader each = reader(n % 2 == 0 ? 0 : 65'536);
    const std::chrono::microseconds pause(n * n * 1500);
    results.push_back(std::async(
        std::launch::async,
        [pause](TurnStreamReader own) { return read_all(std::move(own), pause); },
        std::move(each)));
  }
  for (std::uint32_t number = 0; number < kTurns; ++number) {
    serve(number, 30'000 + number * 200);
    for (int n = 0; n < 2; ++n) step();
  }
  // None is being sent any more: all that was begun is in the kernel, and comes through.
  ASSERT_TRUE(steps_until([&] { return figures().sent + figures().missed == kReaders * kTurns; }));
  const TurnStreamFigures last = figures();
  std::array<PeerFigures, kReaders> peers;
  for (std::size_t n = 0; n < kReaders; ++n) peers[n] = server().peer(n);
  server_.reset();
  for (std::size_t n = 0; n < kReaders; ++n) {
    SCOPED_TRACE(n);
    const Seen seen = results[n].get();
    EXPECT_EQ(seen.wrong, 0U);
    EXPECT_EQ(seen.turns, peers[n].sent);
    EXPECT_EQ(seen.turns + peers[n].missed, kTurns);
  }
  EXPECT_EQ(last.turns, kTurns);
  EXPECT_EQ(last.cut_short, 0U);
  EXPECT_EQ(last.left + last.stalled, 0U);
}

INSTANTIATE_TEST_SUITE_P(Over, TurnStream, testing::Values(Transport::kTcp, Transport::kUnix),
                         transport_name);

TEST(TurnStreamServer, RefusesSettingsOutOfTheirRanges) {
  const std::array configs{
      TurnStreamConfig{.max_points = 0},
      TurnStreamConfig{.max_points = kMostTurnPoints + std::size_t{1}},
      TurnStreamConfig{.max_points = 1, .max_peers = 0},
      TurnStreamConfig{.max_points = 1, .max_peers = 65},
      TurnStreamConfig{.max_points = 1, .stall_limit_ns = 0},
  };
  for (const TurnStreamConfig& config : configs) {
    memory::FixedMemory memory;
    const auto server = TurnStreamServer::open(config, memory);
    ASSERT_FALSE(server.has_value());
    EXPECT_EQ(server.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(memory.total_bytes(), 0U);
  }
}

TEST(TurnStreamServer, TakesRoomForATurnAReaderFromThePlannedMemory) {
  memory::FixedMemory memory;
  const auto server = TurnStreamServer::open({.max_points = 1000, .max_peers = 3}, memory);
  ASSERT_TRUE(server.has_value());
  EXPECT_GE(memory.total_bytes(), 3 * 1000 * sizeof(LabelledPoint));
  EXPECT_LE(memory.total_bytes(), 3 * 1000 * sizeof(LabelledPoint) + 1024);
}

TEST(TurnStreamServer, TellsWhatSendBufferItGot) {
  memory::FixedMemory memory;
  const auto server = TurnStreamServer::open({.max_points = 1000}, memory);
  ASSERT_TRUE(server.has_value());
  EXPECT_THAT(server->send_buffer().asked, testing::HasSubstr("16056 bytes"));
  EXPECT_TRUE(server->send_buffer().granted) << "every system lets a program have so little";
}

}  // namespace
}  // namespace terracut::stream
