// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "frame_pool.hpp"
#include "pipeline/live/sector_pool.hpp"
#include "pipeline/points/complete_objects.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "pipeline/publish/publisher.hpp"
#include "pipeline/publish/reopened.hpp"
#include "pipeline/stream/frame_stream_server.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/background_thread.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// Takes labelled points from the labelling thread and, on a thread of its own, hands them to the
/// readers of the stream and to the queue of every other output: frames, to those that want them
/// sectors, too. The stream needs no queue: its server never waits, and a busy reader misses the
/// frame. If the stream's address is in use, opening it is tried again.
class FrameOutlet {
 public:
  using Slots = FramePool<points::LabelledPoint>;
  struct Stream {
    publish::Reopened<stream::FrameStreamServer> server;
    sensor::SensorModel sensor;
    std::int64_t deadline_ns;
    bool serves_sectors = false;  ///< To readers that ask for them.
    bool serves_objects = false;  ///< With frames; Finders::scene finds them.
  };

  /// Who looks at what is handed out, on this thread; each may be null.
  struct Finders {
    /// Finds what frames are handed out with; the stream gets objects alone.
    std::unique_ptr<points::SceneOfPoints> scene = nullptr;
    /// Finds the objects that outputs get with sectors.
    std::unique_ptr<points::CompleteObjects> complete = nullptr;
    /// Looks at each frame once it is handed out.
    std::unique_ptr<points::SceneOfPoints> sight = nullptr;
  };

  /// `ready` is woken when `slots` has a frame or `sectors` a sector, and by finish(). `sectors`
  /// may be null. All must outlive this object.
  FrameOutlet(std::optional<Stream> stream, publish::Publisher& publisher, Slots& slots,
              SectorPool* sectors, const threads::WakeEvent& ready, Finders finders);
  ~FrameOutlet() { begin_to_finish(); }

  /// Ends the thread; call it after LiveThreads::stop(). Returns false if the thread does not end
  /// in time, which no reader can cause.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

  [[nodiscard]] bool has_stream() const noexcept { return stream_.has_value(); }
  /// Returns how many frames came while the stream's address was in use. For any thread, as is the
  /// next function.
  [[nodiscard]] std::uint64_t frames_while_closed() const noexcept { return while_closed_; }
  [[nodiscard]] std::uint64_t sectors_while_closed() const noexcept {
    return sectors_while_closed_;
  }
  /// Returns how far the sensor sees, by the frames so far; is_watched is 0 without `sight`. For
  /// one other thread.
  [[nodiscard]] const visibility::SightFigures& sight() const noexcept {
    (void)sight_figures_.take_if_new();
    return sight_figures_.newest_taken();
  }
  /// Returns the wall times from the packet of an object's last return until the object was handed
  /// to the outputs, of those that came with sectors, as of the last frame. For one other thread.
  [[nodiscard]] const measure::LogLinearHistogram& object_waits() const noexcept {
    (void)object_waits_.take_if_new();
    return object_waits_.newest_taken();
  }
  /// Returns the stream's figures as of the last frame or second. For one other thread.
  [[nodiscard]] const stream::FrameStreamFigures& figures() const noexcept {
    (void)figures_.take_if_new();
    return figures_.newest_taken();
  }

 private:
  void begin_to_finish();
  void work();
  /// True if the frame reached all outputs, or every output that missed it has counted it.
  [[nodiscard]] bool hand_out(const Slots::Frame& frame);
  void find_scene(const Slots::Frame& frame);
  void look(const Slots::Frame& frame);
  /// Hands out the sectors that came.
  void hand_out_sectors();
  [[nodiscard]] bool publish(const SectorPool::Frame& sector);
  void find_complete_objects(publish::LabelledSector& sector);
  [[nodiscard]] bool stream(const Slots::Frame& frame);
  [[nodiscard]] bool stream(const SectorPool::Frame& sector);
  /// If the stream's address is in use, counts the frame in `while_closed`.
  [[nodiscard]] bool stream(const stream::LabelledFrame& frame,
                            std::atomic<std::uint64_t>& while_closed);
  /// Returns the stream's server; null if there is no stream or its address is in use.
  [[nodiscard]] stream::FrameStreamServer* server() {
    return stream_ ? stream_->server.get() : nullptr;
  }

  std::optional<Stream> stream_;
  publish::Publisher& publisher_;
  Slots& slots_;
  SectorPool* sectors_;
  const threads::WakeEvent& ready_;
  Finders finders_;
  measure::LogLinearHistogram waits_;  ///< What object_waits() is to return.
  std::atomic<bool> finish_{false};
  std::atomic<std::uint64_t> while_closed_{0}, sectors_while_closed_{0};
  mutable queues::LatestValue<stream::FrameStreamFigures> figures_;
  mutable queues::LatestValue<visibility::SightFigures> sight_figures_;
  mutable queues::LatestValue<measure::LogLinearHistogram> object_waits_;
  threads::BackgroundThread thread_;  ///< Declared last, because it uses the members above.
};

}  // namespace terracut::live
