// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/api/point_buffer.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "pipeline/status/named_count.hpp"

namespace terracut::cli {

/// Why a cloud has no answer, or not all of it, beyond the reasons of BufferFault.
enum class NoAnswer : std::uint8_t {
  kNoPlace,      ///< No point has a valid position: NaN, null, beyond 10 km.
  kNoRows,       ///< No field tells lasers apart as in the first clouds.
  kNoTransform,  ///< Transforms do not join its frame with that of the answers.
  kPushedOut,    ///< Newer clouds came before this one was processed.
  kUnanswered,   ///< Labelled, but earlier answers were still being written.
  kUnwritten,    ///< DDS refused an answer.
  kNoScene,      ///< Labelled, but there was no time for its objects and free way.
  kCount,
};

/// Carries news from a node's threads to the thread that shows it. For any thread; locks.
class NodeNews {
 public:
  void count(BufferFault fault) { count(static_cast<std::size_t>(fault)); }
  void count(NoAnswer reason) { count(kFaults + static_cast<std::size_t>(reason)); }
  void came(std::int64_t arrived_ns) {
    const std::scoped_lock lock(mutex_);
    ++clouds_;
    last_cloud_ns_ = arrived_ns;
  }
  /// Adds a cloud that was labelled, or that was skipped because of its deadline.
  void add(const status::FrameRecord& record) {
    const std::scoped_lock lock(mutex_);
    records_.push_back(record);
  }
  void set_sensor(const std::string& sensor) {
    const std::scoped_lock lock(mutex_);
    sensor_ = sensor;
  }
  void set_mount(const status::MountFigures& mount) {
    const std::scoped_lock lock(mutex_);
    mount_ = mount;
  }

  struct State {
    std::uint64_t clouds = 0;        ///< Received clouds.
    std::int64_t last_cloud_ns = 0;  ///< Time of day of the newest; 0 before the first.
    std::string sensor;              ///< Description of the sensor; empty until known.
    status::MountFigures mount;
    std::vector<status::FrameRecord> records;  ///< Records since the previous call.
    std::vector<status::NamedCount> losses;    ///< All reasons by name, also those with 0.
  };
  [[nodiscard]] State look() {
    constexpr std::array<std::string_view, static_cast<std::size_t>(NoAnswer::kCount)> kNames{
        "refused_clouds_no_place", "refused_clouds_no_rows", "refused_clouds_no_transform",
        "pushed_out_clouds",       "unanswered_clouds",      "unwritten_answers",
        "clouds_without_scene"};
    const std::scoped_lock lock(mutex_);
    State state{clouds_, last_cloud_ns_, sensor_, mount_, std::exchange(records_, {}), {}};
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const std::string name =
          i < kFaults ? "refused_clouds_" + std::string(to_string(static_cast<BufferFault>(i)))
                      : std::string(kNames[i - kFaults]);
      state.losses.push_back({name, counts_[i]});
    }
    return state;
  }

 private:
  static constexpr auto kFaults = static_cast<std::size_t>(BufferFault::kCount);

  void count(std::size_t i) {
    const std::scoped_lock lock(mutex_);
    ++counts_[i];
  }

  std::mutex mutex_;
  std::array<std::uint64_t, kFaults + static_cast<std::size_t>(NoAnswer::kCount)> counts_{};
  std::uint64_t clouds_ = 0;
  std::int64_t last_cloud_ns_ = 0;
  std::string sensor_;
  status::MountFigures mount_;
  std::vector<status::FrameRecord> records_;
};

}  // namespace terracut::cli
