// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::status {

/// What there is to say when a run's sensor falls silent, its interface goes away, its head stops,
/// or what was wrong is over; and the silences of a run, counted. One thread; looks at no clock.
class LinkNews {
 public:
  /// `figures` as of now, whose `silences` and `silent_ns` are filled in. A sentence where
  /// something has changed since the last look, else nothing.
  [[nodiscard]] std::string look(MonitorSnapshot& figures);

 private:
  enum class Trouble { kNone, kSilent, kInterfaceGone, kHeadStands };

  [[nodiscard]] static Trouble trouble_of(const MonitorSnapshot& figures) noexcept;

  Trouble trouble_ = Trouble::kNone;
  std::int64_t since_ns_ = 0;  ///< Of this trouble.
  std::uint64_t silences_ = 0;
  std::int64_t silent_ns_ = 0;  ///< Those that are over.
};

}  // namespace terracut::status
