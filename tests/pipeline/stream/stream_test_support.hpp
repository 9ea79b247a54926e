// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <future>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/stream/frame_stream_server.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/frame_stream_reader.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::stream {

using test::FrameStreamReader;
using test::ReceivedFrame;

inline constexpr int kTestPatience_ms = 200'000;

/// Points of which each tells its frame and its place in it.
inline std::vector<points::LabelledPoint> points_of_frame(std::uint32_t number, std::size_t count) {
  std::vector<points::LabelledPoint> points(count);
  for (std::size_t n = 0; n < count; ++n) {
    points[n] = {static_cast<float>(n),
                 static_cast<float>(number),
                 -0.5F,
                 static_cast<std::uint8_t>(n * 7 + number),
                 n % 3 == 0 ? frame::Label::kGround : frame::Label::kObstacle,
                 static_cast<std::uint16_t>(n % 64)};
  }
  return points;
}

/// The same points as they go over the wire.
inline std::vector<WirePoint> on_wire(const std::vector<points::LabelledPoint>& points) {
  std::vector<WirePoint> wire(points.size());
  std::ranges::transform(points, wire.begin(), wire_point);
  return wire;
}

inline status::FrameRecord record_of(std::uint32_t number) {
  status::FrameRecord record;
  record.info.number = number;
  record.info.first_packet_ns = 1'000'000'000LL * number;
  record.info.last_packet_ns = 1'000'000'000LL * number + 99'000'000;
  record.info.complete = true;
  record.labels_ns = 1'000'000'000LL * number + 105'000'000;
  return record;
}
inline LabelledFrame frame_of(const status::FrameRecord& record,
                              const std::vector<points::LabelledPoint>& points, bool late = false) {
  return {header_of(record, sensor::SensorModel::kHdl64e, late, points.size()), points};
}
inline LabelledFrame frame_of(std::uint32_t number,
                              const std::vector<points::LabelledPoint>& points) {
  return frame_of(record_of(number), points);
}

/// A sector of frame `number`: `points` begin at its return `first`.
inline LabelledFrame sector_of(std::uint32_t number, std::uint32_t first,
                               std::span<const points::LabelledPoint> points) {
  const points::SectorRecord record{
      .frame = number, .first_return = first, .first_packet_ns = 1 + first};
  return {header_of(record, sensor::SensorModel::kHdl64e, false, points.size()), points};
}

/// Until `done()` says so, in vain after kTestPatience_ms.
template <class Step, class Done>
[[nodiscard]] bool step_until(const Step& step, const Done& done) {
  const std::int64_t end_ns = measure::monotonic_ns() + kTestPatience_ms * std::int64_t{1'000'000};
  while (!done()) {
    if (measure::monotonic_ns() > end_ns) return false;
    step();
  }
  return true;
}

enum class Transport { kTcp, kUnix };
inline std::ostream& operator<<(std::ostream& out, Transport transport) {
  return out << (transport == Transport::kTcp ? "TCP" : "Unix socket");
}

/// A server on the loopback address or on a Unix socket in a folder of this test's own.
class StreamTest : public test::InScratchFolder, public testing::WithParamInterface<Transport> {
 protected:
  void TearDown() override { server_.reset(); }

  [[nodiscard]] StreamAddress any_address() const {
    if (GetParam() == Transport::kTcp) return {};
    return {.unix_path = (folder_ / "frames").string()};
  }
  void open(FrameStreamConfig config) {
    config.address = any_address();
    auto server = FrameStreamServer::open(config, memory_);
    ASSERT_TRUE(server.has_value()) << server.error().message;
    server_.emplace(*std::move(server));
  }
  [[nodiscard]] FrameStreamServer& server() { return *server_; }
  [[nodiscard]] const FrameStreamFigures& figures() const { return server_->figures(); }

  /// A connected socket, -1 if refused. `receive_buffer_bytes`: 0 leaves the system's choice.
  [[nodiscard]] files::OwnedDescriptor dial(int receive_buffer_bytes = 0) const {
    const StreamAddress& address = server_->address();
    files::OwnedDescriptor socket(
        ::socket(address.is_unix() ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (receive_buffer_bytes > 0) {
      ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes,
                   sizeof receive_buffer_bytes);
    }
    const SocketAddress to = socket_address(address);
    if (::connect(socket.get(), to.get(), to.size) != 0) socket.close();
    return socket;
  }
  /// A connected socket that the server has let in.
  [[nodiscard]] files::OwnedDescriptor join(int receive_buffer_bytes = 0) {
    const std::uint64_t before = figures().connected;
    files::OwnedDescriptor socket = dial(receive_buffer_bytes);
    EXPECT_TRUE(step_until([&] { step(); }, [&] { return figures().connected > before; }));
    return socket;
  }
  [[nodiscard]] FrameStreamReader reader(int receive_buffer_bytes = 0) {
    return FrameStreamReader(join(receive_buffer_bytes));
  }

  /// Reads a message while the server goes on; so large ones come through.
  Expected<bool> receive(FrameStreamReader& reader, ReceivedFrame& frame) {
    auto result =
        std::async(std::launch::async, [&] { return reader.next(frame, kTestPatience_ms); });
    while (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready) step();
    return result.get();
  }

  /// As a sink's thread lives: waits for something to do, for a short time, and does it.
  void step() {
    ::pollfd polled{server_->descriptor(), POLLIN, 0};
    ::poll(&polled, 1, 5);
    server_->work_round();
  }
  memory::FixedMemory memory_;
  std::optional<FrameStreamServer> server_;
};

inline std::string transport_name(const testing::TestParamInfo<Transport>& info) {
  return info.param == Transport::kTcp ? "Tcp" : "Unix";
}

}  // namespace terracut::stream
