// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_io/cloud/cloud.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "pipeline/live/degradation_policy.hpp"
#include "pipeline/run/cloud_pipeline.hpp"
#include "pipeline/terracut/point_buffer.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/mount_watch.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Labels the clouds of a sensor that it knows nothing of before a deadline. The first clouds tell
/// its rows and, unless that is stated, its mount. One thread, which allocates.
class NodeLabeller {
 public:
  explicit NodeLabeller(const Options& options);

  /// Reads a cloud, for learn_from_cloud() or label(). What it says is checked, nothing believed.
  [[nodiscard]] tl::expected<void, RefusedBuffer> read(const PointBuffer& buffer) {
    return unpack(buffer, cloud_);
  }
  /// Whether the cloud read last has any point that is a place.
  [[nodiscard]] bool has_places() const noexcept;

  /// Whether rows and mount are known, as label() needs them.
  [[nodiscard]] bool is_ready() const noexcept { return pipeline_.has_value(); }
  /// Keeps a copy of the cloud read last. True where as many are kept as set_up() can use.
  [[nodiscard]] bool learn_from_cloud();
  /// From the clouds that were kept, which are forgotten. The errors of cloud::learn_rows(), and
  /// of a setup file.
  [[nodiscard]] Status set_up();

  /// Whether a cloud came to its turn after its deadline; then the record says that it is skipped.
  [[nodiscard]] bool skip_if_late(status::FrameRecord& record) const noexcept;
  /// Labels the cloud read last, as far as there is time until `record.info.last_packet_ns` and the
  /// deadline; where that is 0, wholly. Fills in the record. The labels are point_labels(), unless
  /// its level says that it was skipped. The errors of cloud::RowFinder::find().
  [[nodiscard]] Status label(status::FrameRecord& record);
  /// One a point, in the cloud's order.
  [[nodiscard]] const std::vector<frame::Label>& point_labels() const noexcept {
    return pipeline_->point_labels();
  }

  /// Compares the mount with the ground of the cloud labelled last; milliseconds.
  void watch_mount();
  [[nodiscard]] const status::MountFigures& mount() const noexcept { return watch_->figures(); }
  [[nodiscard]] const mount::Mount& mount_in_use() const noexcept { return mount_; }
  /// For people: "64 rows by the field of the laser's number".
  [[nodiscard]] const std::string& sensor() const noexcept { return sensor_; }

 private:
  [[nodiscard]] static ground::MountSearch mount_search(const std::vector<cloud::Cloud>& clouds,
                                                        const cloud::SensorRows& rows);

  const Options& options_;
  std::int64_t deadline_ns_;
  cloud::Cloud cloud_;
  std::vector<cloud::Cloud> kept_;
  std::optional<run::CloudPipeline> pipeline_;
  std::optional<MountWatch> watch_;
  mount::Mount mount_;
  std::string sensor_;
  live::DegradationPolicyOf<measure::SystemClock> degradation_;
};

}  // namespace terracut::cli
