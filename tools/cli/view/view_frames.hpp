// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "rt/memory/used_again.hpp"

namespace terracut::cli {

/// What browsers show, for any number of them: the newest frame, or the sectors of the last turn,
/// and figures of the last 300 frames. A slow browser gets the newest when it is ready for it; no
/// thread waits for it. Any thread without a deadline.
class ViewFrames {
 public:
  struct Kept {
    stream::FrameWireHeader header;
    std::vector<stream::WirePoint> points;
  };
  struct Later {
    std::uint64_t number = 0;  ///< Sequence number of the last one, from 1; 0: none yet.
    std::vector<std::shared_ptr<const Kept>> kept;
    std::uint64_t skipped = 0;  ///< Number of those between that are not kept any more.
  };
  static constexpr std::size_t kFramesShown = 300;
  static constexpr std::size_t kSectorsKept = 128;  ///< More than a turn has.

  explicit ViewFrames(const publish::RunFacts& facts);

  /// Copies the frame; in a run that gives sectors, only its figures.
  void put(const publish::LabelledFrame& frame);
  /// Copies the sector.
  void put_sector(const publish::LabelledSector& sector);
  void put_figures(const status::MonitorSnapshot& figures);

  [[nodiscard]] bool gives_sectors() const noexcept { return facts_.gives_sectors; }
  /// Returns what came after the one of this number, in order.
  [[nodiscard]] Later after(std::uint64_t number) const;
  /// Returns the figures for the page: sensor, rows, deadline_ms or null, frames[] as [ms, level,
  /// missed], losses[] and onlookers[] as [cause, count] (status::is_of_onlookers()); silent_s if
  /// the sensor is silent.
  [[nodiscard]] nlohmann::ordered_json figures() const;

 private:
  struct Shown {
    double ms = 0;
    status::Level level = status::Level::kFull;
    bool missed = false;
  };
  [[nodiscard]] Shown shown(const status::FrameRecord& record) const noexcept;

  publish::RunFacts facts_;
  template <class Record>
  void keep(const Record& record, bool late, std::span<const points::LabelledPoint> points);
  /// Memory for what each browser gets, for the newest frame and for the next one.
  memory::UsedAgain<Kept> rooms_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const Kept>> kept_;  ///< Guarded by mutex_, as are the next members.
  std::uint64_t number_ = 0;                      ///< Of the last one kept.
  std::deque<Shown> shown_;
  frame::LossCounters losses_;
  std::optional<status::MonitorSnapshot> run_;
};

}  // namespace terracut::cli
