// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/vehicle/motion_sample.hpp"
#include "firmware_io/vehicle/planar_pose.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/spsc_queue.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::vehicle {

/// Counts the samples given to an EgoMotion.
struct EgoMotionCounters {
  std::uint64_t accepted = 0;
  std::uint64_t implausible = 0;   ///< Samples that are not finite, or faster than any car.
  std::uint64_t out_of_order = 0;  ///< Samples up to kMotionDisorder_ns before the last one.
  /// Samples refused because the queue was full: the reader was away.
  std::uint64_t not_taken = 0;
};

/// Computes where the sensor was from the vehicle's speed and yaw rate: one thread adds samples,
/// one other asks for poses.
///
///   CAN thread --add()--> SpscQueue --take_new()--> history --poses()--> decoder thread
///
/// Between two samples speed and yaw rate are taken as constant, the mean of both; before the first
/// and after the newest sample they are those of the nearest interval. Poses are known only if
/// samples follow each other within `max_age_ns`; the first sample may be that much after the first
/// instant, the last that much before the last instant. Otherwise there is no ego motion: old
/// values are never used. A stamp more than kMotionDisorder_ns older than the newest (the clock was
/// set back, a log starts over) drops all earlier samples.
///
/// Why it is right between threads: only the queue is shared, and its release of a pushed sample
/// and acquire before it is popped (rt/queues/spsc_queue.hpp) order all there is to order. The
/// history is the reader's alone, the stamp of the last sample the writer's; counters are single
/// relaxed numbers on which nothing else depends. If the reader stays away the queue runs full: the
/// newest samples are refused and counted, and on its return the reader has no ego motion until new
/// samples arrive.
///
/// Memory is taken in the constructor (std::invalid_argument on a bad setting); nothing else
/// allocates, locks or waits.
class EgoMotion {
 public:
  struct Config {
    /// Largest age of a sample that is still used, and largest step between samples; (0, 1 s].
    std::int64_t max_age_ns = 100'000'000;
    /// The sensor's position relative to the middle of the rear axle. The samples give the speed of
    /// that point, which does not move sideways; a sensor ahead of it does when the vehicle yaws:
    /// at 0.5 rad/s, one that is 1.5 m ahead moves 7.5 cm in 0.1 s.
    double sensor_ahead_m = 0, sensor_left_m = 0;
    std::size_t waiting = 256;  ///< Room for samples on their way to the reader; > 0.
    std::size_t kept = 1024;    ///< Newest samples kept; enough for one and a half frames; > 1.
  };

  EgoMotion(const Config& config, memory::FixedMemory& memory);
  EgoMotion(const EgoMotion&) = delete;
  EgoMotion& operator=(const EgoMotion&) = delete;

  /// For the writer. False if the sample is not used; it is then counted.
  bool add(const MotionSample& sample) noexcept TERRACUT_NONBLOCKING;
  /// May be called on any thread.
  [[nodiscard]] EgoMotionCounters counters() const noexcept TERRACUT_NONBLOCKING;

  /// For the reader. Takes over the samples added since the last call.
  void take_new() noexcept TERRACUT_NONBLOCKING;

  /// For the reader. Notes that the clock of the stamps was set, so that all earlier samples are
  /// invalid.
  void reset() noexcept TERRACUT_NONBLOCKING;

  /// For the reader. Computes the sensor's poses at `instants_ns`, which must not decrease, in the
  /// sensor's frame at `reference_ns`. `poses` has the same size. Returns false and leaves `poses`
  /// unchanged unless ego motion is known for all these instants.
  [[nodiscard]] bool poses(std::span<const std::int64_t> instants_ns, std::int64_t reference_ns,
                           std::span<PlanarPose> poses) const noexcept TERRACUT_NONBLOCKING;

  /// For the reader. Returns the stamp of the newest sample taken; nothing without one.
  [[nodiscard]] std::optional<std::int64_t> newest_ns() const noexcept TERRACUT_NONBLOCKING;

 private:
  class Path;

  /// Returns kept sample `number`; 0 is the oldest.
  [[nodiscard]] const MotionSample& kept(std::size_t number) const noexcept;
  /// Returns the last sample at or before this instant; the first if there is none.
  [[nodiscard]] std::size_t last_before(std::int64_t instant_ns) const noexcept;
  /// Returns the sample from which on ego motion is known up to `last_ns`; nothing if it is not
  /// known for the whole time.
  [[nodiscard]] std::optional<std::size_t> beginning_of(std::int64_t first_ns,
                                                        std::int64_t last_ns) const noexcept;

  std::int64_t max_age_ns_;
  PlanarPose axle_sensor_;
  queues::SpscQueue<MotionSample> waiting_;

  // Used by the writer only.
  std::optional<std::int64_t> last_added_ns_;
  std::atomic<std::uint64_t> accepted_{0}, implausible_{0}, out_of_order_{0}, not_taken_{0};

  // Used by the reader only: a ring buffer.
  std::span<MotionSample> ring_;
  std::size_t oldest_ = 0, count_ = 0;
};

}  // namespace terracut::vehicle
