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
#include <vector>

#include "frame_comparison.hpp"
#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"
#include "rt/memory/used_again.hpp"

namespace terracut::cli {

/// The newest frame for any number of browsers, the sectors of the last turns, and figures of the
/// last 300 frames. A slow browser gets the newest frame, or sector, when it is ready for one; no
/// thread waits for it. Any thread without a deadline.
class ViewFrames {
 public:
  struct Kept {
    stream::FrameWireHeader header;
    std::vector<std::byte> points;         ///< As stream::write_points() writes them.
    std::vector<std::uint8_t> comparison;  ///< FrameComparison::of_returns.
  };
  struct Message {
    std::uint64_t number = 0;          ///< Sequence number, from 1; 0: none yet.
    std::shared_ptr<const Kept> kept;  ///< Null: none yet.
  };
  static constexpr std::size_t kFramesShown = 300;
  static constexpr std::size_t kSectorsKept = 256;  ///< More than a turn has.
  /// A browser asks for what was found in a frame when it has read its points, perhaps seconds
  /// later.
  static constexpr std::size_t kFramesWithFinds = 64;

  explicit ViewFrames(const publish::RunFacts& facts, ComparedWith compared = {});

  /// Copies the frame, and what it is compared with.
  void put(const publish::LabelledFrame& frame, const FrameComparison& comparison = {});
  /// Copies the sector; those of a frame come before the frame.
  void put_sector(const publish::LabelledSector& sector);
  void put_figures(const status::MonitorSnapshot& figures);

  [[nodiscard]] bool gives_sectors() const noexcept { return facts_.gives_sectors; }
  [[nodiscard]] Message newest() const;
  /// Returns the sector, or the head of a frame without its points, that follows number `seen`, or
  /// the oldest one if that is not kept any more: a browser then has a whole turn soon.
  [[nodiscard]] Message sector_after(std::uint64_t seen) const;
  /// Returns the figures for the page: sensor, rows, sensor_height_m, deadline_ms or null, frames[]
  /// as [ms, level, missed], losses[] and onlookers[] as [cause, count]
  /// (status::is_of_onlookers()); objects and free_way, whether there are any; compared, null or
  /// whether there is truth, and names[] of one or two sets of parameters; silent_s if the sensor
  /// is silent; sight if the view is watched: state, text, sectors[] clockwise from straight
  /// ahead as [state, visible_m].
  [[nodiscard]] nlohmann::ordered_json figures() const;
  /// Returns what was found in a frame for the page, in the vehicle frame: boxes[] of objects, of
  /// four corners [x_m, y_m], bottom_m and top_m; free_way[], the corners [x_m, y_m] of the free
  /// area; of frames that are compared differing, how many returns, and for each set of parameters
  /// scores[] of iou_g, recall_o, missed and false, counts of returns. All are empty if the frame
  /// is not among the last kFramesWithFinds.
  [[nodiscard]] nlohmann::ordered_json found(std::uint32_t frame) const;
  [[nodiscard]] bool finds_anything() const noexcept {
    return facts_.found.any() || compared_.any();
  }

 private:
  struct Shown {
    double ms = 0;
    status::Level level = status::Level::kFull;
    bool missed = false;
  };
  struct Found {
    std::uint32_t frame;
    std::vector<objects::Object> objects;
    std::vector<free_way::Sector> free_way;
    std::vector<quality::Quality> qualities;  ///< One for each set of parameters.
    std::uint64_t differing = 0;
  };
  [[nodiscard]] Shown shown(const status::FrameRecord& record) const noexcept;

  void keep_sector(std::shared_ptr<const Kept> sector);

  publish::RunFacts facts_;
  ComparedWith compared_;
  /// Memory for one frame per browser, for the newest frame and for the next one; likewise for
  /// sectors.
  memory::UsedAgain<Kept> rooms_, sector_rooms_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Kept> newest_;  ///< Guarded by mutex_, as are the next members.
  std::deque<std::shared_ptr<const Kept>> sectors_;
  std::uint64_t frames_put_ = 0, sectors_put_ = 0;
  std::deque<Shown> shown_;
  std::deque<Found> found_;  ///< Of the last frames, the newest last.
  frame::LossCounters losses_;
  std::optional<status::MonitorSnapshot> run_;
};

}  // namespace terracut::cli
