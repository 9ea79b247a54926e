// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "firmware_io/can/can_frame.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/visibility/sight_figures.hpp"

namespace terracut::health {

/// The state of terracut that two CAN frames report; terracut_health.dbc describes all frames.
struct HealthReport {
  std::uint32_t frame_number = 0;
  std::uint32_t returns = 0;
  status::Level level = status::Level::kFull;
  bool missed = false;
  status::FrameMissCause cause = status::FrameMissCause::kOwnWork;  ///< Valid only if missed.
  std::int64_t latency_ns = -1;  ///< Time from the last packet to the labels; negative: unknown.
  bool ego_motion = false;       ///< True if the frame was deskewed.
  status::LinkState link = status::LinkState::kWaiting;
  std::uint64_t misses = 0;  ///< Missed frames. This and the next two counts are since the start.
  std::uint64_t skipped = 0;
  std::uint64_t losses = 0;
  std::uint32_t alive = 0;  ///< Counter that the caller increments with every report.
};

/// The id of the first frame in terracut_health.dbc; the ids of the others follow it.
inline constexpr can::CanId kHealthId{1744, false};

/// Makes a report from the figures of a running process. Leaves `alive` unset.
[[nodiscard]] HealthReport health_report_of(const status::MonitorSnapshot& figures,
                                            const status::FrameRecord& newest) noexcept;

/// Returns the frames TERRACUT_FRAME and TERRACUT_TOTALS, to be sent in this order. If a value is
/// too large for its signal, latency and returns saturate, counters wrap to 0. `first` is the id of
/// the first frame; the second frame has the next id. With an id other than kHealthId, readers need
/// a changed DBC file.
[[nodiscard]] std::array<can::CanFrame, 2> health_frames(const HealthReport& report,
                                                         can::CanId first = kHealthId) noexcept;

/// Returns the frame TERRACUT_SIGHT of a run in which the sensor's view is watched. Its id is two
/// higher than `first`, that of the first frame; `alive` is the report's.
[[nodiscard]] can::CanFrame sight_frame(const visibility::SightFigures& sight, std::uint32_t alive,
                                        can::CanId first = kHealthId) noexcept;

}  // namespace terracut::health
