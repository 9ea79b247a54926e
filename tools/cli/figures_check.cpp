// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "figures_check.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "calib/angle.hpp"

namespace terracut::cli {
namespace {

/// Some 146 years: far from what overflows when times are added or subtracted.
constexpr std::int64_t kFar_ns = std::int64_t{1} << 62;

bool is_time(std::int64_t ns) noexcept {
  return ns >= 0 && ns < kFar_ns;
}
bool is_difference(std::int64_t ns) noexcept {
  return ns > -kFar_ns && ns < kFar_ns;
}

bool are_possible(const rt::LogLinearHistogram& times) noexcept {
  if (!is_time(times.max_ns()) || !is_time(times.min_ns())) return false;
  if (!std::isfinite(times.sum_ns()) || times.sum_ns() < 0) return false;
  if (times.mean_ns() >= static_cast<double>(kFar_ns)) return false;
  std::int64_t least_ns = 0;
  for (const double percent : {50.0, 90.0, 99.0, 99.9}) {
    const std::int64_t ns = times.percentile_ns(percent);
    if (ns < least_ns) return false;
    least_ns = ns;
  }
  return least_ns <= times.max_ns();
}

bool are_possible(const rt::MotionFigures& motion) noexcept {
  const double most = static_cast<double>(kFar_ns);
  return motion.state < rt::MotionState::kCount && motion.fault_count <= motion.faults.size() &&
         is_time(motion.last_sample_ns) && is_difference(motion.newest_sample_after_turn_ns) &&
         is_difference(motion.least_sample_after_turn_ns) &&
         is_difference(motion.most_sample_after_turn_ns) &&
         std::abs(motion.mean_sample_after_turn_ns()) < most;
}

}  // namespace

bool are_possible(const rt::MonitorSnapshot& figures) noexcept {
  for (const std::int64_t ns : {figures.started_ns, figures.taken_ns, figures.deadline_ns,
                                figures.last_packet_ns, figures.silent_ns}) {
    if (!is_time(ns)) return false;
  }
  for (const std::int32_t cdeg : {figures.blind_from_cdeg, figures.blind_to_cdeg}) {
    if (cdeg < 0 || cdeg >= calib::kTurn_cdeg) return false;
  }
  if (figures.link >= rt::LinkState::kCount || !std::isfinite(figures.frames_per_s) ||
      figures.loss_count > figures.losses.size() ||
      figures.outcome_count > figures.outcomes.size() ||
      figures.thread_count > figures.threads.size() ||
      figures.stage_count > figures.stage_names.size() || !are_possible(figures.motion)) {
    return false;
  }
  for (const auto* times : {&figures.latency, &figures.wall, &figures.total_cpu,
                            &figures.decode_cpu, &figures.segment_cpu}) {
    if (!are_possible(*times)) return false;
  }
  return std::ranges::all_of(figures.stage_cpu,
                             [](const auto& times) { return are_possible(times); });
}

}  // namespace terracut::cli
