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
  ::mode_t unix_mode = ListeningSocket::kOwnerAndGroup;  ///< Rights of a Unix socket's file.
  std::size_t max_points = 0;  ///< Of a frame: the images' return_capacity(). [1, kMostFramePoints]
  std::size_t max_peers = 4;   ///< Readers connected at once; each needs room for a frame. [1, 64]
  /// A reader that takes nothing for so long while a frame waits for it is disconnected: it hangs,
  /// or its machine is gone without a word. > 0
  std::int64_t stall_limit_ns = 30'000'000'000;
  std::size_t send_buffer_bytes = 0;  ///< The kernel's, a reader. 0: enough for a frame.
};

/// A frame given to the stream.
struct LabelledFrame {
  status::FrameRecord record;
  sensor::SensorModel sensor = sensor::SensorModel::kUnknown;
  bool late = false;  ///< Labelled after its deadline.
  std::span<const points::LabelledPoint> points{};
};

/// Counts since the start. Of each frame taken, every connected reader either was sent it, missed
/// it, lost it when it left, or is being sent it.
struct FrameStreamFigures {
  std::uint64_t frames = 0;            ///< Taken by serve().
  std::uint64_t frames_too_large = 0;  ///< Not taken: more than max_points.
  std::uint64_t sent = 0;              ///< Whole frames times readers, given to the kernel.
  std::uint64_t missed = 0;            ///< The reader was busy with an earlier frame.
  std::uint64_t cut_short = 0;         ///< The reader left before the frame's end.
  std::uint64_t bytes = 0;

  std::uint64_t connected = 0;  ///< Readers that got a place.
  std::uint64_t refused = 0;    ///< Came while all places were taken.
  std::uint64_t left = 0;       ///< Closed their end, died, or were unreachable.
  std::uint64_t stalled = 0;    ///< Disconnected by stall_limit_ns.
  std::uint64_t accept_failures = 0;
  int accept_error = 0;  ///< errno of the newest failed accept().
};

struct PeerFigures {
  bool connected = false;
  std::uint64_t connection = 0;  ///< Number in order of connection, from 1; 0: place never used.
  std::uint64_t sent = 0;
  std::uint64_t missed = 0;
};

/// Hands labelled frames to other processes over TCP or a Unix socket
/// (docs/reference/labelled_stream.md). A reader gets whole frames, the newest one whenever it is
/// free; while it is busy with a frame it misses others. Nothing queues up, no reader delays
/// another or the caller, and whatever happens to a reader is counted, never an error.
///
/// Room for frames: as many as readers. A frame is copied once however many readers take it, and
/// kept until the last of them has it; a reader that is free holds none, so there is always room
/// for the frame that it takes.
///
/// Thread contract: one thread, of normal priority; it makes system calls that cost up to a few
/// milliseconds with a frame's bytes, and none that waits. Nothing is allocated after open().
class FrameStreamServer {
 public:
  /// kInvalidArgument: a setting out of its range. Otherwise errors of ListeningSocket::open().
  [[nodiscard]] static Expected<FrameStreamServer> open(const FrameStreamConfig& config,
                                                        memory::FixedMemory& memory);

  FrameStreamServer(FrameStreamServer&&) noexcept = default;
  FrameStreamServer& operator=(FrameStreamServer&&) noexcept = default;
  ~FrameStreamServer() = default;

  /// Takes the frame and begins to send it to every free reader. False, and counted, if it has more
  /// than max_points. `frame.points` may be reused afterwards.
  bool serve(const LabelledFrame& frame) noexcept;

  /// Continues sending, accepts readers and drops those that are gone. Call it when descriptor()
  /// can be read, and at least once a second.
  void work_round() noexcept;

  /// Returns a descriptor for poll() and WakeEvent::wait(): readable when work_round() has
  /// something to do.
  [[nodiscard]] int descriptor() const noexcept { return events_.get(); }

  /// Returns the address, with the port the system chose if asked to.
  [[nodiscard]] const StreamAddress& address() const noexcept { return listener_.address(); }
  /// Returns what the kernel gives each reader as send buffer.
  [[nodiscard]] const threads::Grant& send_buffer() const noexcept { return send_buffer_; }
  [[nodiscard]] const FrameStreamFigures& figures() const noexcept { return figures_; }
  [[nodiscard]] std::size_t peers() const noexcept;
  /// Returns the figures of the reader in this place, or the last one there. place in [0,
  /// max_peers)
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
    FrameWireHeader header;      ///< The frame being sent.
    std::size_t slot = kNoSlot;  ///< Slot of its points, until all are given to the kernel.
    std::size_t given_bytes = 0;
    std::size_t backlog_bytes = 0;  ///< Bytes not sent yet when last seen, in the kernel or not.
    std::int64_t progress_ns = 0;   ///< Monotonic time when it last shrank or began.
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
  std::size_t send_buffer_bytes_ = 0;  ///< 0: chosen by TCP.
  threads::Grant send_buffer_;
  std::vector<Peer> peers_;
  std::span<Slot> slots_;
  FrameStreamFigures figures_;
  std::int64_t listen_again_ns_ = 0;  ///< Monotonic time; 0: listening.
};

}  // namespace terracut::stream
