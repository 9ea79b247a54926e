// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <tl/expected.hpp>

#include "pipeline/recorder/dump_folder.hpp"
#include "pipeline/recorder/dump_record.hpp"

namespace terracut::recorder {

/// Allows `burst` dumps at once, and one more for every `interval_s` that passes.
struct DumpRate {
  double interval_s = 60;  ///< Time until one more dump is allowed, (0, 1e6]
  int burst = 1;           ///< Dumps allowed at once, [1, 1000]
};

struct DumpLimits {
  DumpFolderLimits folder;
  /// This rate is limited, because a process that misses every deadline must not keep the disk
  /// busy.
  DumpRate missed_deadline{.interval_s = 60, .burst = 1};
  DumpRate asked{.interval_s = 10, .burst = 3};
};

/// Counts the requests for a dump by outcome.
struct DumpCounters {
  std::array<std::uint64_t, kDumpReasons> wanted{};  ///< Indexed by DumpReason.
  std::uint64_t written = 0;
  std::array<std::uint64_t, kDumpRefusals> refused{};  ///< Indexed by DumpRefusal.
  std::uint64_t deleted = 0;  ///< Old dumps deleted to make room for new ones.
};

/// Decides by rate limits, the folder's quota and the least free space whether a dump may be
/// written. Counts each dump as written or as refused for its reason: wanted = written + refused.
///
/// For one thread: the thread that writes dumps.
class DumpPolicy {
 public:
  /// Throws std::invalid_argument for a limit out of range.
  explicit DumpPolicy(const DumpLimits& limits);

  /// Makes the first check, before anything is copied: kTooSoon if the rate limit of `reason` is
  /// reached. Each success uses up one allowed dump, even if none is written afterwards, because an
  /// attempt costs as much. `monotonic_ns` is a clock that is never set.
  [[nodiscard]] tl::expected<void, RefusedDump> admit(DumpReason reason, std::int64_t monotonic_ns);

  /// Makes the second check, when the size is known, by DumpFolder::make_room().
  [[nodiscard]] tl::expected<std::filesystem::path, RefusedDump> make_room(
      std::uint64_t bytes, DumpReason reason, std::int64_t realtime_ns);

  /// Counts a refusal that the recorder itself found, and returns the refusal.
  [[nodiscard]] tl::unexpected<RefusedDump> refuse(RefusedDump refused);
  void note_written() noexcept { ++counters_.written; }

  [[nodiscard]] const DumpCounters& counters() const noexcept { return counters_; }

 private:
  /// How many dumps the rate allows now: each dump takes one away, time adds them again.
  struct Allowance {
    DumpRate rate;
    double left = 0;
    std::int64_t filled_ns = 0;
    bool started = false;
  };

  std::array<Allowance, kDumpReasons> allowances_;
  DumpFolder folder_;
  DumpCounters counters_;
};

}  // namespace terracut::recorder
