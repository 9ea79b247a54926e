// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/vehicle/ego_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace terracut::vehicle {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// Plausible limits; they also bound the rotation between two samples.
constexpr double kFastest_mps = 150, kFastest_radps = 10;

bool is_plausible(const MotionSample& sample) noexcept {
  // The comparisons are also false for NaN.
  return std::abs(sample.speed_mps) <= kFastest_mps &&
         std::abs(sample.yaw_rate_radps) <= kFastest_radps;
}

double seconds(std::int64_t from_ns, std::int64_t to_ns) noexcept {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

EgoMotion::Config checked(const EgoMotion::Config& config) {
  if (config.max_age_ns <= 0 || config.max_age_ns > kSecond_ns) {
    throw std::invalid_argument("EgoMotion: the maximum age must be in (0, 1 s]");
  }
  if (config.waiting < 1 || config.kept < 2) {
    throw std::invalid_argument("EgoMotion needs room for a waiting sample and two that are kept");
  }
  if (!(std::abs(config.sensor_ahead_m) <= 100) || !(std::abs(config.sensor_left_m) <= 100)) {
    throw std::invalid_argument("EgoMotion: the sensor must be within 100 m of the rear axle");
  }
  return config;
}

}  // namespace

/// Walks the vehicle's path from one of its samples, in the order of time.
class EgoMotion::Path {
 public:
  Path(const EgoMotion& motion, std::size_t from) noexcept : motion_(motion), at_(from) {}

  /// `instant_ns` must not decrease from call to call.
  [[nodiscard]] PlanarPose sensor_at(std::int64_t instant_ns) noexcept {
    while (at_ + 1 < motion_.count_ && motion_.kept(at_ + 1).stamp_ns <= instant_ns) {
      at_pose_ = at_pose_ * since_sample(motion_.kept(at_ + 1).stamp_ns);
      ++at_;
    }
    return at_pose_ * since_sample(instant_ns) * motion_.axle_sensor_;
  }

 private:
  [[nodiscard]] PlanarPose since_sample(std::int64_t instant_ns) const noexcept {
    const MotionSample& from = motion_.kept(at_);
    const MotionSample& to = motion_.kept(std::min(at_ + 1, motion_.count_ - 1));
    return after_constant_motion((from.speed_mps + to.speed_mps) / 2,
                                 (from.yaw_rate_radps + to.yaw_rate_radps) / 2,
                                 seconds(from.stamp_ns, instant_ns));
  }

  const EgoMotion& motion_;
  std::size_t at_;
  PlanarPose at_pose_;
};

EgoMotion::EgoMotion(const Config& config, memory::FixedMemory& memory)
    : max_age_ns_(checked(config).max_age_ns),
      axle_sensor_{config.sensor_ahead_m, config.sensor_left_m, 1, 0},
      waiting_("ego motion", config.waiting, memory),
      ring_(memory.take<MotionSample>("ego motion", config.kept)) {}

bool EgoMotion::add(const MotionSample& sample) noexcept {
  const auto count = [](std::atomic<std::uint64_t>& counter) {
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  };
  if (!is_plausible(sample)) {
    count(implausible_);
    return false;
  }
  if (last_added_ns_ && sample.stamp_ns <= *last_added_ns_ &&
      *last_added_ns_ - sample.stamp_ns <= kMotionDisorder_ns) {
    count(out_of_order_);
    return false;
  }
  if (!waiting_.try_push(sample)) {
    count(not_taken_);
    return false;
  }
  last_added_ns_ = sample.stamp_ns;
  count(accepted_);
  return true;
}

EgoMotionCounters EgoMotion::counters() const noexcept {
  return {accepted_.load(std::memory_order_relaxed), implausible_.load(std::memory_order_relaxed),
          out_of_order_.load(std::memory_order_relaxed),
          not_taken_.load(std::memory_order_relaxed)};
}

void EgoMotion::take_new() noexcept {
  MotionSample sample;
  // Takes only the samples that wait now: a writer that keeps adding must not keep the reader in
  // this loop.
  for (std::size_t left = waiting_.size_approx(); left > 0 && waiting_.try_pop(sample); --left) {
    if (const auto newest = newest_ns(); newest && sample.stamp_ns <= *newest) count_ = 0;
    if (count_ == ring_.size()) {
      oldest_ = (oldest_ + 1) % ring_.size();
      --count_;
    }
    ring_[(oldest_ + count_++) % ring_.size()] = sample;
  }
}

void EgoMotion::reset() noexcept {
  take_new();
  count_ = 0;
}

std::optional<std::int64_t> EgoMotion::newest_ns() const noexcept {
  if (count_ == 0) return std::nullopt;
  return kept(count_ - 1).stamp_ns;
}

const MotionSample& EgoMotion::kept(std::size_t number) const noexcept {
  return ring_[(oldest_ + number) % ring_.size()];
}

std::size_t EgoMotion::last_before(std::int64_t instant_ns) const noexcept {
  std::size_t low = 0, high = count_;  // kept(low) is at or before the instant, kept(high) after it
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (kept(middle).stamp_ns <= instant_ns ? low : high) = middle;
  }
  return low;
}

std::optional<std::size_t> EgoMotion::beginning_of(std::int64_t first_ns,
                                                   std::int64_t last_ns) const noexcept {
  if (count_ == 0) return std::nullopt;
  const auto apart = [this](std::size_t number) {  // the gap before this sample is too long
    return kept(number).stamp_ns - kept(number - 1).stamp_ns > max_age_ns_;
  };
  std::size_t at = last_before(last_ns);
  if (last_ns - kept(at).stamp_ns > max_age_ns_) return std::nullopt;
  if (kept(at).stamp_ns < last_ns && at + 1 < count_ && apart(at + 1)) return std::nullopt;
  while (at > 0 && kept(at).stamp_ns > first_ns && !apart(at)) --at;
  if (kept(at).stamp_ns - first_ns > max_age_ns_) return std::nullopt;
  return at;
}

bool EgoMotion::poses(std::span<const std::int64_t> instants_ns, std::int64_t reference_ns,
                      std::span<PlanarPose> poses) const noexcept {
  if (instants_ns.empty()) return true;
  const std::int64_t first_ns = std::min(instants_ns.front(), reference_ns);
  const std::int64_t last_ns = std::max(instants_ns.back(), reference_ns);
  const std::optional<std::size_t> from = beginning_of(first_ns, last_ns);
  if (!from) return false;
  const PlanarPose T_reference_start = inverse(Path(*this, *from).sensor_at(reference_ns));
  Path path(*this, *from);
  for (std::size_t i = 0; i < instants_ns.size(); ++i) {
    poses[i] = T_reference_start * path.sensor_at(instants_ns[i]);
  }
  return true;
}

}  // namespace terracut::vehicle
