// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::status {

/// Reports when a run's sensor falls silent, its interface goes away, its head stops, or such
/// trouble ends; also counts the silences. One thread; reads no clock.
class LinkNews {
 public:
  /// Fills in `silences` and `silent_ns` of the present `figures`. Returns a sentence if something
  /// has changed since the last call, else an empty text.
  [[nodiscard]] std::string look(MonitorSnapshot& figures);

 private:
  enum class Trouble { kNone, kSilent, kInterfaceGone, kHeadStands };

  [[nodiscard]] static Trouble trouble_of(const MonitorSnapshot& figures) noexcept;

  Trouble trouble_ = Trouble::kNone;
  std::int64_t since_ns_ = 0;  ///< Start of the present trouble.
  std::uint64_t silences_ = 0;
  std::int64_t silent_ns_ = 0;  ///< Duration of all past silences.
};

}  // namespace terracut::status
