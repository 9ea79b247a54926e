// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "firmware_io/can/can_frame.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::health {

/// How terracut is, in as much as fits two CAN frames. terracut_health.dbc is the description of
/// those for readers.
struct HealthReport {
  std::uint32_t frame_number = 0;
  std::uint32_t returns = 0;
  status::Level level = status::Level::kFull;
  bool missed = false;
  status::FrameMissCause cause =
      status::FrameMissCause::kOwnWork;  ///< Means something only if missed.
  std::int64_t latency_ns = -1;  ///< From the last packet to the labels; negative: not known.
  bool ego_motion = false;       ///< The frame was deskewed.
  status::LinkState link = status::LinkState::kWaiting;
  std::uint64_t misses = 0;  ///< Since the start, as the next two.
  std::uint64_t skipped = 0;
  std::uint64_t losses = 0;
  std::uint32_t alive = 0;  ///< To be counted up with every report.
};

/// The ids that terracut_health.dbc has; the second one follows the first.
inline constexpr can::CanId kHealthId{1744, false};

/// What the figures of a live process say. `alive` they do not know.
[[nodiscard]] HealthReport health_report_of(const status::MonitorSnapshot& figures,
                                            const status::FrameRecord& newest) noexcept;

/// TERRACUT_FRAME and TERRACUT_TOTALS, to be sent in this order. Numbers that do not fit: a latency
/// and returns stay at the most there is, counts begin again at 0. `first` is the id of the one,
/// the other has the next; where it is not kHealthId, readers need a changed DBC.
[[nodiscard]] std::array<can::CanFrame, 2> health_frames(const HealthReport& report,
                                                         can::CanId first = kHealthId) noexcept;

}  // namespace terracut::health
