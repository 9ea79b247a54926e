// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/status/frame_record.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "pipeline/stream/listening_socket.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::stream {

struct FrameStreamConfig {
  StreamAddress address{};
  ::mode_t unix_mode = ListeningSocket::kOwnerAndGroup;  ///< Rights of a Unix socket's file.
  std::size_t max_points = 0;  ///< Most points of a frame or sector, [1, kMostFramePoints]
  std::size_t max_peers = 4;   ///< Readers connected at once, [1, 64]
  /// A reader that takes nothing for this time (> 0) while a frame waits for it is disconnected: it
  /// hangs, or its machine has vanished.
  std::int64_t stall_limit_ns = 30'000'000'000;
  std::size_t send_buffer_bytes = 0;  ///< The kernel's buffer per reader; 0: enough for a frame.
  bool serves_sectors = false;        ///< Readers that ask for sectors get them.
  bool has_heights = false;           ///< Points come with their heights above the ground.
  bool has_objects = false;  ///< Points come with heights and the numbers of their objects.
};

/// A frame, or a sector of one, to be sent to the stream's readers.
struct LabelledFrame {
  FrameWireHeader header;  ///< From header_of().
  std::span<const points::LabelledPoint> points{};
  std::span<const float> heights_m{};  ///< One per point; sent with FrameStreamConfig::has_heights.
  /// One per point, 0: none; sent with FrameStreamConfig::has_objects. Empty of sectors.
  std::span<const std::uint16_t> objects{};
};

/// Counts since the start. A message is a frame or, for readers by sectors, a sector or the header
/// of a frame. For each connected reader, every message was sent, was missed, was cut short when
/// the reader left, or is being sent.
struct FrameStreamFigures {
  std::uint64_t frames = 0, sectors = 0;  ///< Taken by serve().
  std::uint64_t frames_too_large = 0;     ///< Frames not taken, with more than max_points.
  std::uint64_t sent = 0;                 ///< Whole messages given to the kernel, per reader.
  std::uint64_t missed = 0;          ///< Frames missed as the reader was busy with an earlier one.
  std::uint64_t sectors_missed = 0;  ///< Messages missed by readers by sectors.
  std::uint64_t cut_short = 0;       ///< Messages whose reader left before their end.
  std::uint64_t bytes = 0;

  std::uint64_t connected = 0;  ///< Readers that were accepted.
  std::uint64_t refused = 0;    ///< Readers that came while max_peers were connected.
  std::uint64_t left = 0;       ///< Readers that closed, died or became unreachable.
  std::uint64_t stalled = 0;    ///< Readers disconnected by stall_limit_ns.
  std::uint64_t accept_failures = 0;
  int accept_error = 0;  ///< errno of the newest failed accept().
};

struct PeerFigures {
  bool connected = false;
  std::uint64_t connection = 0;  ///< Serial number of the connection, from 1; 0: none yet.
  std::uint64_t sent = 0;
  std::uint64_t missed = 0;
};

/// Hands labelled frames to other processes over TCP or a Unix socket
/// (docs/reference/labelled_stream.md). A reader gets whole frames, and always the newest one when
/// it is free; frames that come while it is busy with another are missed. Nothing queues up, no
/// reader delays another or the caller, and whatever happens to a reader is counted, never an
/// error.
///
/// There is memory for as many frames as readers. A frame is copied once, however many readers take
/// it, and kept until the last of them has it; a free reader holds no frame, so there is always
/// memory for the next frame that it takes.
///
/// A reader that asks for sectors gets these in place of frames, and after the last one of a frame
/// the frame's header. What it has not read waits in the kernel's buffer, for sectors come a
/// millisecond after each other; while that is full, it misses what comes.
///
/// For one thread of normal priority: it makes system calls that take up to a few milliseconds for
/// a frame's bytes, but never waits. Allocates nothing after open().
class FrameStreamServer {
 public:
  /// Fails with kInvalidArgument for a setting out of range, else as ListeningSocket::open() does.
  [[nodiscard]] static Expected<FrameStreamServer> open(const FrameStreamConfig& config,
                                                        memory::FixedMemory& memory);

  FrameStreamServer(FrameStreamServer&&) noexcept = default;
  FrameStreamServer& operator=(FrameStreamServer&&) noexcept = default;
  ~FrameStreamServer() = default;

  /// Takes a frame or sector and begins to send it to every free reader of frames, or of sectors.
  /// Sectors come before their frame. Returns false, and counts the frame, if it has more than
  /// max_points. `frame.points` may be reused after the call.
  bool serve(const LabelledFrame& frame) noexcept;

  /// Continues sending, accepts readers and drops those that have gone. Call it when descriptor()
  /// is readable, and at least once a second.
  void work_round() noexcept;

  /// Returns a descriptor for poll() and WakeEvent::wait(): readable when work_round() has
  /// something to do.
  [[nodiscard]] int descriptor() const noexcept { return events_.get(); }

  /// Returns the address; its port is the system's choice if port 0 was asked for.
  [[nodiscard]] const StreamAddress& address() const noexcept { return listener_.address(); }
  /// Returns the size of the send buffer that the kernel gives each reader.
  [[nodiscard]] const threads::Grant& send_buffer() const noexcept { return send_buffer_; }
  [[nodiscard]] const FrameStreamFigures& figures() const noexcept { return figures_; }
  [[nodiscard]] std::size_t peers() const noexcept;
  /// Returns the figures of the present or last reader at this place, [0, max_peers).
  [[nodiscard]] const PeerFigures& peer(std::size_t place) const noexcept {
    return peers_[place].figures;
  }

 private:
  static constexpr std::size_t kNoSlot = static_cast<std::size_t>(-1);

  struct Slot {
    std::span<std::byte> room;
    std::size_t holders = 0;
  };
  struct Peer {
    files::OwnedDescriptor socket;
    PeerFigures figures;
    std::array<char, 4> asked{};  ///< The first bytes that the reader sent.
    std::size_t asked_bytes = 0;
    bool by_sectors = false;
    FrameWireHeader header;      ///< Header of the message being sent.
    std::size_t slot = kNoSlot;  ///< Slot of its points until all are in the kernel.
    std::size_t given_bytes = 0;
    std::size_t backlog_bytes = 0;  ///< Bytes not yet sent when last checked.
    std::int64_t progress_ns = 0;   ///< Monotonic time when the backlog began or last shrank.
  };

  FrameStreamServer(const FrameStreamConfig& config, ListeningSocket listener,
                    files::OwnedDescriptor events, memory::FixedMemory& memory);

  void handle_events() noexcept;
  void let_in() noexcept;
  void take_in(files::OwnedDescriptor socket) noexcept;
  void hear(Peer& peer) noexcept;
  void watch_listener(bool watch) noexcept;
  void look_after(Peer& peer, std::int64_t now_ns) noexcept;
  [[nodiscard]] std::size_t free_slot() const noexcept;
  /// Begins to send a message to every free reader of frames, or of sectors.
  void hand_out(const LabelledFrame& message, bool by_sectors) noexcept;
  void begin(Peer& peer, std::size_t slot, const FrameWireHeader& header) noexcept;
  void give(Peer& peer) noexcept;
  void release(Peer& peer) noexcept;
  void part_with(Peer& peer, std::uint64_t& counter) noexcept;
  void watch(Peer& peer, int operation) noexcept;
  [[nodiscard]] std::size_t backlog(const Peer& peer) const noexcept;

  FrameStreamConfig config_;
  std::size_t point_bytes_;
  ListeningSocket listener_;
  files::OwnedDescriptor events_;      ///< epoll
  std::size_t send_buffer_bytes_ = 0;  ///< 0: chosen by TCP.
  threads::Grant send_buffer_;
  std::vector<Peer> peers_;
  std::span<Slot> slots_;
  FrameStreamFigures figures_;
  std::int64_t listen_again_ns_ = 0;  ///< Monotonic time; 0: listening.
};

}  // namespace terracut::stream
