// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string_view>

#include "rt/nonblocking.hpp"
#include "rt/scheduler_times.hpp"

namespace terracut::rt {

/// Why a stretch of work took longer than it might.
enum class MissCause : std::uint8_t {
  kNone,            ///< It did not.
  kOwnWork,         ///< It would have been late even with a core of its own: terracut is too slow.
  kWaitedForACore,  ///< Other threads had its core: give it a priority, or a core.
  kSlept,           ///< It went to sleep: a lock, a disk, a page that had been swapped out.
  kStolenTime,      ///< The host of this virtual machine had its core, or interrupts.
};

/// `work` is the difference of two readings around a stretch that took its thread `work.wall_ns`
/// and may have taken `budget_ns`. `stolen_ns` is the difference of two StolenTime readings around
/// it, or 0 when unknown. Real-time safe.
[[nodiscard]] MissCause name_miss_cause(const SchedulerReading& work, std::int64_t stolen_ns,
                                        std::int64_t budget_ns) noexcept TERRACUT_NONBLOCKING;

/// "waited for a core", for reports.
[[nodiscard]] std::string_view to_string(MissCause cause) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::rt
