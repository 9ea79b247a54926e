// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

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
  ::mode_t unix_mode = ListeningSocket::kOwnerAndGroup;  ///< Of a Unix socket's file.
  std::size_t max_points = 0;  ///< Of a frame: the images' return_capacity(). [1, kMostFramePoints]
  std::size_t max_peers = 4;   ///< Connected at once; each costs room for a frame. [1, 64]
  /// A reader that takes nothing for so long while a frame waits for it is disconnected: it hangs,
  /// or its machine is gone without a word. > 0
  std::int64_t stall_limit_ns = 30'000'000'000;
  std::size_t send_buffer_bytes = 0;  ///< The kernel's, for each reader. 0: takes a frame at once.
};

/// A frame as it is given to the stream.
struct LabelledFrame {
  status::FrameRecord record;
  sensor::SensorModel sensor = sensor::SensorModel::kUnknown;
  bool late = false;  ///< Labelled after its deadline.
  std::span<const points::LabelledPoint> points{};
};

/// Since the start. Of each frame that was taken, every reader connected then either was sent it,
/// missed it, lost it when it went, or is just being sent it.
struct FrameStreamFigures {
  std::uint64_t frames = 0;            ///< Taken by serve().
  std::uint64_t frames_too_large = 0;  ///< Not taken: more than max_points.
  std::uint64_t sent = 0;              ///< Frames times readers, whole, given to the kernel.
  std::uint64_t missed = 0;            ///< The reader was busy with an earlier frame.
  std::uint64_t cut_short = 0;         ///< The reader went before the frame's end.
  std::uint64_t bytes = 0;

  std::uint64_t connected = 0;  ///< Readers that got a place.
  std::uint64_t refused = 0;    ///< Came when all places were taken.
  std::uint64_t left = 0;       ///< Closed their end, died, or were unreachable.
  std::uint64_t stalled = 0;    ///< Disconnected by stall_limit_ns.
  std::uint64_t accept_failures = 0;
  int accept_error = 0;  ///< errno of the newest of them.
};

struct PeerFigures {
  bool connected = false;
  std::uint64_t connection = 0;  ///< 1.. in order of coming; 0: nobody had this place yet.
  std::uint64_t sent = 0;
  std::uint64_t missed = 0;
};

/// Hands labelled frames to other processes over TCP or a Unix socket
/// (docs/reference/labelled_stream.md). Whole frames, the newest that finds the reader free: one
/// that is still busy with an earlier frame misses this one. Nothing queues up, no reader delays
/// another or the caller, and whatever a reader does or suffers is counted, never an error.
///
/// Room for frames: as many as readers. A frame is copied once however many readers take it, and
/// kept until the last of them has it; a reader that is free holds none, so there is always room
/// for the frame that it takes.
///
/// Thread contract: one thread, of normal priority; it makes system calls that cost up to a few
/// milliseconds with a frame's bytes, and none that waits. Nothing is allocated after open().
class FrameStreamServer {
 public:
  /// kInvalidArgument: a setting out of its range. Otherwise as ListeningSocket::open().
  [[nodiscard]] static Expected<FrameStreamServer> open(const FrameStreamConfig& config,
                                                        memory::FixedMemory& memory);

  FrameStreamServer(FrameStreamServer&&) noexcept = default;
  FrameStreamServer& operator=(FrameStreamServer&&) noexcept = default;
  ~FrameStreamServer() = default;

  /// Takes the frame and begins to send it to every reader that is free. False, and counted, when
  /// it has more than max_points. `frame.points` is not needed any more afterwards.
  bool serve(const LabelledFrame& frame) noexcept;

  /// Goes on sending, lets readers in and takes leave of those that are gone. To be called when
  /// descriptor() can be read, and once a second or more often.
  void work_round() noexcept;

  /// For poll() and WakeEvent::wait(): can be read when work_round() has something to do.
  [[nodiscard]] int descriptor() const noexcept { return events_.get(); }

  /// With the port the system chose, where it was asked to.
  [[nodiscard]] const StreamAddress& address() const noexcept { return listener_.address(); }
  /// What the kernel gives each reader as send buffer.
  [[nodiscard]] const threads::Grant& send_buffer() const noexcept { return send_buffer_; }
  [[nodiscard]] const FrameStreamFigures& figures() const noexcept { return figures_; }
  [[nodiscard]] std::size_t peers() const noexcept;
  /// Of the reader in this place, or the one that had it last. place in [0, max_peers)
  [[nodiscard]] const PeerFigures& peer(std::size_t place) const noexcept {
    return peers_[place].figures;
  }

 private:
  static constexpr std::size_t kNoSlot = static_cast<std::size_t>(-1);

  struct Slot {
    std::span<WirePoint> room;
    std::size_t points = 0;
    std::size_t holders = 0;
  };
  struct Peer {
    files::OwnedDescriptor socket;
    PeerFigures figures;
    FrameWireHeader header;      ///< Of the frame that is being sent.
    std::size_t slot = kNoSlot;  ///< Its points, as long as not all is given to the kernel.
    std::size_t given_bytes = 0;
    std::size_t backlog_bytes = 0;  ///< Not given to the kernel, or not out of it, when last seen.
    std::int64_t progress_ns = 0;   ///< Monotonic; when it last got smaller, or began.
  };

  FrameStreamServer(const FrameStreamConfig& config, ListeningSocket listener,
                    files::OwnedDescriptor events, memory::FixedMemory& memory);

  void handle_events() noexcept;
  void let_in() noexcept;
  void take_in(files::OwnedDescriptor socket) noexcept;
  void watch_listener(bool watch) noexcept;
  void look_after(Peer& peer, std::int64_t now_ns) noexcept;
  [[nodiscard]] std::size_t free_slot() const noexcept;
  void begin(Peer& peer, std::size_t slot, const LabelledFrame& frame) noexcept;
  void give(Peer& peer) noexcept;
  void release(Peer& peer) noexcept;
  void part_with(Peer& peer, std::uint64_t& counter) noexcept;
  void watch(Peer& peer, int operation, bool for_room) noexcept;
  [[nodiscard]] std::size_t backlog(const Peer& peer) const noexcept;
  [[nodiscard]] std::size_t frame_bytes(const Peer& peer) const noexcept;

  FrameStreamConfig config_;
  ListeningSocket listener_;
  files::OwnedDescriptor events_;      ///< epoll
  std::size_t send_buffer_bytes_ = 0;  ///< 0: left to TCP.
  threads::Grant send_buffer_;
  std::vector<Peer> peers_;
  std::span<Slot> slots_;
  FrameStreamFigures figures_;
  std::int64_t listen_again_ns_ = 0;  ///< 0: listening.
};

}  // namespace terracut::stream
