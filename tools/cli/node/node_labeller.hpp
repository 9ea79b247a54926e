// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "degradation_policy.hpp"
#include "firmware_io/cloud/cloud.hpp"
#include "pipeline/api/point_buffer.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/run/cloud_pipeline.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/mount_watch.hpp"
#include "tools/cli/input/tree_mount.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Labels the clouds of an unknown sensor before a deadline. The first clouds show the sensor's
/// rows and, unless stated, its mount. For one thread, which allocates.
class NodeLabeller {
 public:
  explicit NodeLabeller(const Options& options);

  /// Reads a cloud for learn_from_cloud() or label(), checking all its fields.
  [[nodiscard]] tl::expected<void, RefusedBuffer> read(const PointBuffer& buffer) {
    return unpack(buffer, cloud_);
  }
  /// True if the cloud read last has a point with valid coordinates.
  [[nodiscard]] bool has_places() const noexcept;

  /// True if a figure of the mount is not stated, so that set_up() will look for it.
  [[nodiscard]] bool is_mount_open() const noexcept { return cli::is_mount_open(stated_); }
  /// States the figures that are not stated yet, in time for set_up().
  void state_mount(const mount::Mount& mount) { stated_ = filled_in(std::move(stated_), mount); }

  /// True if rows and mount are known, which label() requires.
  [[nodiscard]] bool is_ready() const noexcept { return pipeline_.has_value(); }
  /// Keeps a copy of the cloud read last. Returns true once there are enough clouds for set_up().
  [[nodiscard]] bool learn_from_cloud();
  /// Learns rows and mount from the kept clouds, then drops these. Fails with the errors of
  /// cloud::learn_rows() and of a setup file.
  [[nodiscard]] Status set_up();

  /// True if the cloud's deadline passed before labelling began; then marks the record as skipped.
  [[nodiscard]] bool skip_if_late(status::FrameRecord& record) const noexcept;
  /// Labels the cloud read last by its deadline, which is counted from
  /// `record.info.last_packet_ns`, or completely if that stamp is 0. Fills in the record. The
  /// labels are in point_labels(), unless the record's level is kSkipped. Fails with the errors of
  /// cloud::RowFinder::find().
  [[nodiscard]] Status label(status::FrameRecord& record);
  /// Returns one label per point, in the cloud's order.
  [[nodiscard]] const std::vector<frame::Label>& point_labels() const noexcept {
    return pipeline_->point_labels();
  }

  /// Returns the height of each point above the ground, in the cloud's order; empty unless asked
  /// for.
  [[nodiscard]] const std::vector<float>& point_heights_m() const noexcept {
    return pipeline_->point_heights_m();
  }

  /// Looks for what is wanted in the cloud labelled last, which takes milliseconds, and sets it in
  /// `scene`, in the vehicle frame of mount_in_use().
  void find_scene(publish::LabelledFrame& scene);

  /// Compares the mount with the ground of the cloud labelled last; takes milliseconds.
  void watch_mount();
  [[nodiscard]] const status::MountFigures& mount() const noexcept { return watch_->figures(); }
  [[nodiscard]] const mount::Mount& mount_in_use() const noexcept { return mount_; }
  /// Describes the sensor: "64 rows by the field of the laser's number".
  [[nodiscard]] const std::string& sensor() const noexcept { return sensor_; }

 private:
  [[nodiscard]] static ground::MountSearch mount_search(const std::vector<cloud::Cloud>& clouds,
                                                        const cloud::SensorRows& rows);

  const Options& options_;
  MountOptions stated_;
  std::int64_t deadline_ns_;
  cloud::Cloud cloud_;
  std::vector<cloud::Cloud> kept_;
  std::optional<run::CloudPipeline> pipeline_;
  memory::FixedMemory scene_memory_;
  std::optional<scene::SceneFinder> scene_;  ///< Exists if anything is to be found.
  std::optional<MountWatch> watch_;
  mount::Mount mount_;
  std::string sensor_;
  DegradationPolicyOf<measure::SystemClock> degradation_;
};

}  // namespace terracut::cli
