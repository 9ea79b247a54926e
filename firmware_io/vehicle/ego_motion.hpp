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

/// What became of the samples given to an EgoMotion.
struct EgoMotionCounters {
  std::uint64_t accepted = 0;
  std::uint64_t implausible = 0;   ///< Not finite, or faster than any car.
  std::uint64_t out_of_order = 0;  ///< Not after the one before, by kMotionDisorder_ns at most.
  std::uint64_t not_taken = 0;     ///< The reader was away and the queue is full.
};

/// Where the sensor was, from the vehicle's speed and yaw rate: one thread gives samples, one
/// other asks for poses.
///
///   CAN thread --add()--> SpscQueue --take_new()--> history --poses()--> decoder thread
///
/// Between two samples speed and yaw rate are constant, the mean of both; before the first and
/// behind the newest they are those of the nearest stretch. Poses are known only where samples
/// follow each other within `max_age_ns`; the first may lie that long behind the first instant
/// asked for, and the last that long before the last instant. Otherwise there is no ego motion: old
/// values are never used. A stamp more than kMotionDisorder_ns older than the newest begins anew
/// (the clock was set back, a log starts over) and drops what was before.
///
/// Why it is right between threads: only the queue is shared, and its release of a pushed sample
/// and acquire before it is popped (rt/queues/spsc_queue.hpp) order all there is to order. The
/// history is the reader's alone, the stamp of the last sample the writer's; counters are single
/// relaxed numbers that nothing else hangs on. A reader that stays away makes the queue run full:
/// then the newest samples are refused and counted, and what it finds on its return is too old to
/// be used until samples arrive again.
///
/// Memory is taken in the constructor (std::invalid_argument on a bad setting); nothing else
/// allocates, locks or waits.
class EgoMotion {
 public:
  struct Config {
    /// A sample this much older than what is asked for is of no use any more; (0, 1 s].
    std::int64_t max_age_ns = 100'000'000;
    /// The sensor's place, seen from the middle of the rear axle. The samples give that point's
    /// speed, and it does not slip sideways; a sensor ahead of it does when the vehicle yaws: 1.5 m
    /// ahead, at 0.5 rad/s, 7.5 cm in 0.1 s.
    double sensor_ahead_m = 0, sensor_left_m = 0;
    std::size_t waiting = 256;  ///< Samples on their way to the reader; > 0.
    std::size_t kept = 1024;    ///< Of the newest; one and a half frames need theirs; > 1.
  };

  EgoMotion(const Config& config, memory::FixedMemory& memory);
  EgoMotion(const EgoMotion&) = delete;
  EgoMotion& operator=(const EgoMotion&) = delete;

  /// Writer only. False when the sample is not used, which is counted.
  bool add(const MotionSample& sample) noexcept TERRACUT_NONBLOCKING;
  /// Any thread.
  [[nodiscard]] EgoMotionCounters counters() const noexcept TERRACUT_NONBLOCKING;

  /// Reader only: takes over what was added since.
  void take_new() noexcept TERRACUT_NONBLOCKING;

  /// Reader only: the clock of the stamps was set, so all samples added until now are of another
  /// time.
  void reset() noexcept TERRACUT_NONBLOCKING;

  /// Reader only: the sensor's poses at `instants_ns`, which do not fall, in the frame it has at
  /// `reference_ns`. `poses` is as long. False, and `poses` untouched, where there is no ego motion
  /// for the whole span.
  [[nodiscard]] bool poses(std::span<const std::int64_t> instants_ns, std::int64_t reference_ns,
                           std::span<PlanarPose> poses) const noexcept TERRACUT_NONBLOCKING;

  /// Reader only: stamp of the newest sample taken; nothing without one.
  [[nodiscard]] std::optional<std::int64_t> newest_ns() const noexcept TERRACUT_NONBLOCKING;

 private:
  class Path;

  /// Of those kept, 0 is the oldest.
  [[nodiscard]] const MotionSample& kept(std::size_t number) const noexcept;
  /// The last sample at or before this instant; the first where none is.
  [[nodiscard]] std::size_t last_before(std::int64_t instant_ns) const noexcept;
  /// The sample from which on there is ego motion for this whole span; nothing where there is not.
  [[nodiscard]] std::optional<std::size_t> beginning_of(std::int64_t first_ns,
                                                        std::int64_t last_ns) const noexcept;

  std::int64_t max_age_ns_;
  PlanarPose axle_sensor_;
  queues::SpscQueue<MotionSample> waiting_;

  // The writer's.
  std::optional<std::int64_t> last_added_ns_;
  std::atomic<std::uint64_t> accepted_{0}, implausible_{0}, out_of_order_{0}, not_taken_{0};

  // The reader's: a ring.
  std::span<MotionSample> ring_;
  std::size_t oldest_ = 0, count_ = 0;
};

}  // namespace terracut::vehicle
